"""Lumping judged by others: libsdformat on small files and on the examples, Drake on the examples."""

from pathlib import Path

import numpy as np
import pytest

import twinform
from testbed.corpus.files import ROOT
from testbed.lumping.causes import cause_of
from testbed.lumping.differences import differences
from tests.oracles.probes import MISSING, PROBES
from tests.profile import DEEP
from twinform.testing import oracles
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import describe
from twinform.testing.oracles.robot import Matrix, Sample, inverse
from twinform.testing.oracles.robot_comparison import read_robot

_EXAMPLES = [ROOT / "examples" / f"{name}.urdf" for name in ("arm", "four_wheels", "gripper", "rover")]
_COMPAT = "lump-fixed-joints{compat=libsdformat}"
_LINKS = 7
"""The links of the rover that have mass, at least."""
_SWAPPED = "019_limit_swapped"
"""libsdformat exchanges limits that are upside down, with a warning on the console."""

with_libsdformat = pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
with_drake = pytest.mark.skipif(not oracles.available("drake"), reason="Drake is not installed")
_FILES = [*_EXAMPLES, *(path for path in sorted(PROBES.glob("*.urdf")) if b'"fixed"' in path.read_bytes())]
_SOME = _FILES if DEEP else _FILES[::2]


@with_libsdformat
@pytest.mark.skipif(not PROBES.is_dir(), reason=MISSING)
@pytest.mark.parametrize("path", _SOME, ids=lambda path: path.stem)
def test_lumping_as_libsdformat_does_gives_its_result(path: Path, tmp_path: Path) -> None:
    try:
        theirs = describe(path)
        made = twinform.convert(path, to="sdf", sdf_version="1.9", passes=_COMPAT)
    except (RuntimeError, twinform.CompileError):
        pytest.skip("one of both refuses the file")
    output = tmp_path / "lumped.sdf"
    output.write_text(made.text)
    ours, model = describe(output), twinform.load(path).models[0]
    found = [each for each in differences(theirs, ours) if not cause_of(each, theirs, ours, model)]
    assert {each.kind for each in found} == ({"lower", "upper"} if path.stem == _SWAPPED else set())


@with_drake
@pytest.mark.parametrize("passes", ["lump-fixed-joints", _COMPAT])
@pytest.mark.parametrize("path", _EXAMPLES, ids=lambda path: path.stem)
def test_a_lumped_example_is_the_same_robot_to_drake(path: Path, passes: str, tmp_path: Path) -> None:
    output = tmp_path / "lumped.sdf"
    output.write_text(twinform.convert(path, to="sdf", passes=passes).text)
    verdict = oracles.compare(path, output, engine="drake", lumped=True)
    assert verdict, verdict


@with_drake
@pytest.mark.parametrize("suffix", ["urdf", "sdf"])
def test_links_move_alike_whichever_of_them_is_the_root(suffix: str, tmp_path: Path) -> None:
    source, output = tmp_path / f"source.{suffix}", tmp_path / f"rerooted.{suffix}"
    to = "urdf" if suffix == "urdf" else "sdf"
    source.write_text(twinform.convert(ROOT / "examples/rover.urdf", to=to).text)
    output.write_text(twinform.convert(source, to=to, passes="reroot{link=rear_left_wheel}").text)
    before, after = read_robot(source, "drake"), read_robot(output, "drake")
    assert {*before.joints} == {*after.joints}
    for one, other in zip(before.samples, after.samples, strict=True):
        here, there = _from_base(one), _from_base(other)
        links = here.keys() & there.keys()
        assert len(links) >= _LINKS
        assert all(np.allclose(here[name], there[name], atol=1e-9) for name in links)


def _from_base(sample: Sample) -> dict[str, Matrix]:
    """Where the links are, seen from the same one."""
    back = inverse(sample.poses["base_link"])
    return {name: back @ pose for name, pose in sample.poses.items()}
