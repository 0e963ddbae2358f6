"""MuJoCo makes the same model of MJCF with classes of defaults as without them."""

import warnings
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.mjcf.canonical_models import differences, package_files

mujoco: Any = pytest.importorskip("mujoco")

_CASES = Path(__file__).parents[1] / "cases"
_SOURCES = [
    path
    for folder in ("to_mjcf", "from_mjcf", "mjcf", "whole")
    for path in sorted((_CASES / folder).iterdir())
    if path.suffix in {".urdf", ".sdf", ".mjcf"} and ".expected" not in path.name
]
_PASSES = "check-inertia"
"""A pass that changes nothing: without any, MJCF would stay the text that it is."""
_STEP = 8


def _differences(path: Path) -> list[str] | None:
    """Return what differs with classes; None where MuJoCo does not take the file without them either."""
    try:
        plain, factored = (
            twinform.convert(path, to="mjcf", passes=_PASSES, default_classes=factors) for factors in (False, True)
        )
    except twinform.CompileError:
        return None
    models: list[Any] = []
    for each in (plain, factored):
        spec = _spec(each.text, path)
        if spec is None:
            return None if each is plain else ["it is refused"]
        models.append(spec)
    return differences(mujoco, *models)


def _spec(text: str, path: Path) -> Any:
    try:
        spec = mujoco.MjSpec.from_string(text)
        spec.modelfiledir = str(path.parent)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it warns of masses that hardly move
            return spec.compile()
    except ValueError:
        return None


@pytest.mark.parametrize("path", _SOURCES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_a_case_with_classes_is_the_same_model(path: Path) -> None:
    found = _differences(path)
    if found is None:
        pytest.skip("refused without classes, too")
    assert found == []


@pytest.mark.slow
@pytest.mark.skipif(not package_files(), reason="`make mjcf` downloads the packages")
@pytest.mark.parametrize("part", range(_STEP))
def test_a_file_of_a_package_with_classes_is_the_same_model(part: int) -> None:
    found = {str(path): _differences(path) for path in package_files()[part::_STEP]}
    assert {path: each for path, each in found.items() if each} == {}
