"""Tags that Gazebo does not apply, and collisions that it calls otherwise: found as libsdformat does it, and fixed."""

from itertools import product
from pathlib import Path

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import parse
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import RobotRow, describe, describing

pytestmark = pytest.mark.slow

_NAMES = (
    None,
    "c",
    "base",
    "base_c",
    "arm",
    "arm_collision",
    "base_fixed_joint_lump__c",
    "x_fixed_joint_lump__arm_collision",
)
_PAIRS = [*((name, None) for name in _NAMES), *(("base", name) for name in _NAMES)]
_ARMS = ("arm", "base_arm")
_MU = {"base": 0.25, "arm": 0.5}
_TOLD = frozenset({"early-static", "untagged-shape", "renamed-collision"})
_STATICS = ("", "<static>true</static>", "<static>false</static>", "<self_collide>true</self_collide>")


def _robot(arm: str, names: tuple[str | None, str | None], tagged: tuple[str, ...] = ("base", "arm")) -> str:
    """A base and an arm that is fixed to it with a collision each, at another height, and a friction for each."""
    links = "".join(_link(*each) for each in zip(("base", arm), names, (1, 2), strict=True))
    joint = f"<joint name='j' type='fixed'><parent link='base'/><child link='{arm}'/></joint>"
    named = {"base": "base", "arm": arm}
    tags = "".join(f"<gazebo reference='{named[each]}'><mu1>{_MU[each]}</mu1></gazebo>" for each in tagged)
    return f"<robot name='r'>{links}{joint}{tags}</robot>"


def _link(link: str, name: str | None, radius: int) -> str:
    called = "" if name is None else f" name='{name}'"
    shape = f"<collision{called}><geometry><sphere radius='{radius}'/></geometry></collision>"
    return f"<link name='{link}'>{INERTIAL}{shape}</link>"


def _found(text: str, reader: str = "gazebo") -> list[str]:
    (found,) = assess_file(text.encode(), parse(reader), LoadOptions(), name="robot.urdf")
    return [each.finding.rule.name for each in found.judgments if each.finding.rule.name in _TOLD]


def _frictions(robot: RobotRow) -> list[float]:
    shapes = [shape for link in robot["links"] for shape in link["shapes"]]
    return [float(shape["values"].get("surface/friction/ode/mu", "1")) for shape in shapes]


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_a_static_robot_that_libsdformat_12_3_lets_move_is_found(tmp_path: Path) -> None:
    urdf, sdf = tmp_path / "robot.urdf", tmp_path / "robot.sdf"
    with describing() as read:
        for contents in product(_STATICS, repeat=3):
            tags = "".join(f"<gazebo reference=''>{each}</gazebo>" for each in contents)
            urdf.write_text(f"<robot name='r'><link name='base'>{INERTIAL}</link>{tags}</robot>")
            made = twinform.convert(urdf, to="sdf", sdf_version="1.9")
            sdf.write_text(made.text)
            differs = read(urdf)["static"] != read(sdf)["static"]
            assert ("early-static" in _found(urdf.read_text(), "gazebo@fortress")) is differs, tags
            assert ("early-static" in {each.rule.name for each in made.diagnostics}) is differs, tags
            assert "early-static" not in _found(urdf.read_text(), "gazebo@harmonic")


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("arm", _ARMS)
@pytest.mark.parametrize("tagged", [("base", "arm"), ("base",), ("arm",)])
def test_shapes_are_tagged_as_libsdformat_does_and_all_well_after_the_pass(
    arm: str, tagged: tuple[str, ...], tmp_path: Path
) -> None:
    path = tmp_path / "robot.urdf"
    meant = [_MU[each] if each in tagged else 1.0 for each in ("base", "arm")]
    for names in _PAIRS if len(tagged) > 1 else _PAIRS[::3]:
        text = _robot(arm, names, tagged)
        path.write_text(text)
        wrong = sum(one != other for one, other in zip(_frictions(describe(path)), meant, strict=True))
        assert len(_found(text)) == wrong, names
        fixed = twinform.convert(text.encode(), to="urdf", profiles="gazebo", name="robot.urdf").text
        path.write_text(fixed)
        assert (_frictions(describe(path)), _found(fixed)) == (meant, []), names


def test_a_contact_sensor_names_collisions_as_gazebo_does(tmp_path: Path) -> None:
    sensor = "<sensor name='s' type='contact'><contact><collision>c</collision></contact></sensor>"
    extension = f"<gazebo reference='base'>{sensor}</gazebo></robot>"
    text = _robot("arm", ("c", None), ()).replace("</robot>", extension)
    assert _found(text) == ["renamed-collision"]
    fixed = twinform.convert(text.encode(), to="urdf", profiles="gazebo", name="robot.urdf").text
    assert "<collision>base_fixed_joint_lump__c_collision</collision>" in fixed
    assert _found(fixed) == []


def test_a_robot_of_usual_names_has_nothing_to_say() -> None:
    assert _found(_robot("arm", (None, None))) == _found(_robot("arm", ("base_c", "arm_collision_c"))) == []
