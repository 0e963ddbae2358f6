"""Robots of every version of URDF, written in every other one, to urdfdom 6 and Pinocchio, and on the way back."""

from pathlib import Path

import pytest

import twinform
from testbed.mutated.versioned import versioned
from testbed.oracles import urdfdom
from tests.profile import DEEP
from twinform.compiler import as_refused
from twinform.request_options import URDF_VERSIONS, UrdfVersion
from twinform.testing import oracles
from twinform.testing.oracles.robot_comparison import compared

CHUNKS = 4
EACH = 500 if DEEP else 40


def _accepted(chunk: int, folder: Path) -> list[Path]:
    """The documents that both of us take."""
    found: list[Path] = []
    for seed in range(chunk * EACH, (chunk + 1) * EACH):
        path = folder / f"{seed}.urdf"
        path.write_bytes(versioned(seed).text)
        refused = any(each.is_error for each in as_refused(twinform.check(path)).diagnostics)
        if not refused and not (urdfdom.available_6() and urdfdom.complaints_of_6(path)):
            found.append(path)
    return found


@pytest.mark.skipif(not urdfdom.available_6(), reason=urdfdom.MISSING_6)
@pytest.mark.parametrize("version", URDF_VERSIONS)
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_urdfdom_6_reads_what_is_written_in_another_version(chunk: int, version: UrdfVersion, tmp_path: Path) -> None:
    complaints: dict[str, tuple[str, ...]] = {}
    paths = _accepted(chunk, tmp_path)
    for path in paths:
        made = tmp_path / f"made-{path.name}"
        try:
            made.write_text(twinform.convert(path, to="urdf", urdf_version=version).text, encoding="utf-8")
        except twinform.CompileError as error:
            errors = {each.rule.name for each in error.diagnostics if each.is_error}
            assert errors <= {"out-of-range"}
            continue
        if found := urdfdom.complaints_of_6(made):
            complaints[path.name] = found
    assert complaints == {}
    assert len(paths) > EACH // 5


@pytest.mark.skipif(not oracles.available("pinocchio"), reason="Pinocchio is not here: pip install '.[oracles]'")
@pytest.mark.parametrize("version", URDF_VERSIONS)
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_pinocchio_which_reads_1_2_says_the_same_robot(chunk: int, version: UrdfVersion, tmp_path: Path) -> None:
    differences: dict[str, str] = {}
    for path in _accepted(chunk, tmp_path):
        made = tmp_path / f"made-{path.name}"
        made.write_text(twinform.convert(path, to="urdf", urdf_version=version).text, encoding="utf-8")
        if not (found := compared(path, made, ("pinocchio", "pinocchio"), lumped=False)):
            differences[path.name] = found.cause
    assert differences == {}


@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_down_and_up_again_is_the_same_robot(chunk: int, tmp_path: Path) -> None:
    differences: dict[str, list[str]] = {}
    for path in _accepted(chunk, tmp_path):
        text = path.read_text()
        if "1.2" not in text.splitlines()[0] or "capsule" in text:  # which becomes three shapes
            continue
        down = twinform.convert(path, to="urdf", urdf_version="1.0").text
        up = twinform.convert(down.encode(), name="down.urdf", to="urdf", urdf_version="1.2").text
        found = twinform.diff(path, up.encode()).differences
        if found := [each for each in found if "1e+16" not in str(each)]:
            differences[path.name] = list(map(str, found))
    assert differences == {}
