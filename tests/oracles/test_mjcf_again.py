"""A file of MJCF that became SDF or URDF is the same model again where that is written as MJCF."""

from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.mjcf.home_trips import came_home

mujoco: Any = pytest.importorskip("mujoco")

_CASES = Path(__file__).parents[1] / "cases/from_mjcf"
_NO_FILES = [each for each in sorted(_CASES.glob("*.mjcf")) if "file=" not in each.read_text()]
_ROBOTS = [each for each in _NO_FILES if not twinform.load(each).worlds]


def _back(case: Path, to: Any) -> list[str]:
    between = twinform.convert(case, to=to).text.encode()
    model = mujoco.MjModel.from_xml_path(str(case))
    return came_home(mujoco, case, model, twinform.convert(between, to="mjcf").text)


@pytest.mark.parametrize("case", _NO_FILES, ids=lambda case: case.stem)
def test_a_file_comes_home_from_sdf(case: Path) -> None:
    assert _back(case, "sdf") == []


@pytest.mark.parametrize("case", _ROBOTS, ids=lambda case: case.stem)
def test_a_file_comes_home_from_urdf(case: Path) -> None:
    assert _back(case, "urdf") == []


_SLIDER = (
    '<mujoco><compiler inertiafromgeom="false"/><worldbody><body><joint type="slide" axis="1 0 0"/>'
    '<inertial pos="0 0 0" quat="{}" mass="{}" diaginertia="{}"/></body></worldbody></mujoco>'
)


def test_the_axes_of_a_slider_are_no_difference_and_its_mass_is(tmp_path: Path) -> None:
    source = tmp_path / "slider.xml"
    source.write_text(_SLIDER.format("1 1 0 0", "3", "2 1 2"))
    model = mujoco.MjModel.from_xml_path(str(source))
    turned, heavy = (came_home(mujoco, source, model, _SLIDER.format("1 0 0 0", each, "2 2 1")) for each in "34")
    assert not [each for each in turned if each.startswith("array")]
    assert "array body_mass" in heavy
