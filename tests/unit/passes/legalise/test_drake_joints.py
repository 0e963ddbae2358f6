"""Drake's own joints of URDF: which are read, and what becomes of an edited one."""

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.diagnostics import Diagnostic

_ROBOT = f"""<robot xmlns:drake="http://drake.mit.edu" name="r">
<link name="a">{INERTIAL}</link><link name="b">{INERTIAL}</link>
<drake:joint name="j" type="{{}}"><parent link="{{}}"/><child link="b"/>{{}}</drake:joint></robot>"""
_PITCH = '<drake:screw_thread_pitch value="{}"/>'


def _sdf(kind: str, inside: str = "", parent: str = "a") -> str:
    return twinform.convert(_ROBOT.format(kind, parent, inside).encode(), to="sdf").text


def _errors(kind: str, inside: str = "") -> list[Diagnostic]:
    with pytest.raises(twinform.CompileError) as refused:
        _sdf(kind, inside)
    return [each for each in refused.value.diagnostics if each.is_error]


@pytest.mark.parametrize("kind", ["curvilinear", "revolute", "gearbox", ""])
def test_other_types_are_no_joints_of_sdf(kind: str) -> None:
    (found,) = _errors(kind)
    assert (found.rule.name, found.location.line) == ("joint-type-unsupported", 3)
    assert found.location.path == "/robot[@name='r']/drake:joint[@name='j']/@type"


@pytest.mark.parametrize("inside", ["", _PITCH.format("fast"), _PITCH.format("nan"), "<drake:screw_thread_pitch/>"])
def test_a_screw_has_a_pitch(inside: str) -> None:
    (found,) = _errors("screw", inside)
    assert found.rule.name == "missing-part"
    assert found.message == "screw joint 'j' has no <drake:screw_thread_pitch> with a number"


def test_what_is_wrong_in_a_joint_has_its_place() -> None:
    (found,) = _errors("ball", '<origin xyz="0 0"/>')
    assert (found.rule.name, found.location.line) == ("invalid-value", 3)
    assert found.location.path == "/robot[@name='r']/drake:joint[@name='j']/origin/@xyz"


def test_an_undeclared_prefix_is_that_of_drake() -> None:
    text = _ROBOT.format("ball", "a", "").replace(' xmlns:drake="http://drake.mit.edu"', "")
    assert '<joint name="j" type="ball">' in twinform.convert(text.encode(), to="sdf").text


def test_drake_has_a_body_called_world() -> None:
    text = _ROBOT.format("ball", "world", '<origin xyz="0 0 1"/>').replace(f'<link name="a">{INERTIAL}</link>', "")
    sdf = twinform.convert(text.encode(), to="sdf").text
    assert "<pose>0 0 1 0 0 0</pose>" in sdf.replace(' relative_to="__model__"', "")
    assert "<parent>world</parent>" in sdf


def test_the_axis_that_drake_does_not_read_is_dropped() -> None:
    made = twinform.convert(_ROBOT.format("universal", "a", '<axis xyz="0 0 1"/>').encode(), to="sdf")
    assert "<xyz>1 0 0</xyz>" in made.text
    assert [each.message for each in made.ledger.entries if each.fate.value == "dropped"] == [
        "Drake turns universal joint 'j' about x and y, whatever its axis is"
    ]


def test_without_carriers_it_is_a_joint() -> None:
    text = _ROBOT.format("screw", "a", _PITCH.format(0.1))
    sdf = twinform.convert(text.encode(), to="sdf", carriers=False).text
    assert '<joint name="j" type="screw">' in sdf
    assert "urn:twinform" not in sdf


@pytest.mark.parametrize(
    ("kind", "inside", "old", "new"),
    [
        ("universal", "", "<xyz>0 1 0</xyz>", "<xyz>0 0 1</xyz>"),
        ("universal", "", "<xyz>1 0 0</xyz>", "<xyz>1 0 0</xyz><dynamics><damping>1</damping></dynamics>"),
        ("universal", "", "universal", "revolute2"),
    ],
)
def test_what_drake_could_not_say_is_a_chain(kind: str, inside: str, old: str, new: str) -> None:
    back = twinform.convert(_sdf(kind, inside).replace(old, new).encode(), to="urdf").text
    assert "<drake:joint" not in back
    assert [each.message for each in twinform.check(back.encode()).diagnostics if each.is_error] == []
    assert "<tf:chain" in back


@pytest.mark.parametrize(
    ("kind", "inside", "old", "new", "shown"),
    [
        ("screw", _PITCH.format(0.1), "0.1</", "0.3</", 'screw_thread_pitch value="0.3"'),
        ("ball", "", 'type="ball"', 'type="fixed"', '<joint name="j" type="fixed">'),
        ("ball", '<origin xyz="1 0 0"/>', ">1 0 0 0 0 0<", ">2 0 0 0 0 0<", '<origin xyz="2 0 0"'),
    ],
)
def test_an_edit_counts(kind: str, inside: str, old: str, new: str, shown: str) -> None:
    assert shown in twinform.convert(_sdf(kind, inside).replace(old, new).encode(), to="urdf").text
