"""Loops that other readers close in URDF come back from SDF, where they are joints."""

from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.profile import examples
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Axis, Document, Element, Joint, Opaque, Pose
from twinform.ir.foreign_joints import LOOP_FORMS, EndForm
from twinform.ir.frames import FrameGraph
from twinform.ir.joint import JointType
from twinform.ir.transform import Transform
from twinform.schemas import format_value
from twinform.testing import assert_round_trip, strategies

_DRAKE = "http://drake.mit.edu"
_TYPES: Mapping[str, tuple[str, ...]] = {
    "loop_joint": ("spherical", "ball", "continuous", "revolute", "prismatic"),
    "constraint": ("spherical", "continuous", "prismatic", "universal", "fixed"),
    "drake:ball_constraint": ("",),
}


def _name(word: str) -> str:
    return f"{{{_DRAKE}}}{word.removeprefix('drake:')}" if word.startswith("drake:") else word


def _end(end: EndForm, link: str, point: Pose) -> list[Element]:
    """An end as a person would write it, with all numbers."""
    numbers = [(name, format_value(getattr(point, name) or (0.0, 0.0, 0.0))) for name in ("xyz", "rpy")]
    named = (end.attribute, link)
    if end.place == end.link:
        return [Element(name=end.link, attributes=(named, *numbers))]
    placed = (("value", numbers[0][1]),) if end.place.startswith("drake:") else tuple(numbers)
    return [Element(name=_name(end.link), attributes=(named,)), Element(name=_name(end.place), attributes=placed)]


def _loop(word: str, kind: str, name: str, axis: str, ends: tuple[tuple[str, Pose], tuple[str, Pose]]) -> Opaque:
    form = LOOP_FORMS[word]
    attributes = (("name", name), ("type", kind)) if form.attributes else ()
    axes = [form.parent.axis] if kind in {"continuous", "revolute", "prismatic"} else []
    axes += [form.parent.axis, form.child.axis] if kind == "universal" else []
    children = [*_end(form.parent, *ends[0]), *_end(form.child, *ends[1])]
    children += [Element(name=each, attributes=(("xyz", axis),)) for each in axes if axis]
    return Opaque(element=Element(name=_name(word), attributes=attributes, children=tuple(children)))


def _rounded(pose: Pose) -> Pose:
    """A pose in numbers that a person may write: the content of elements with a prefix is compared literally."""
    x, y, z = pose.xyz or (0.0, 0.0, 0.0)
    return pose.copy(xyz=(round(x, 9), round(y, 9), round(z, 9)))


_MOVING = ("revolute", "continuous", "prismatic", "floating")


@st.composite
def robots_with_loops(draw: st.DrawFn, *, joint_types: tuple[JointType, ...] = _MOVING) -> Document:
    """A robot with loops that are closed where all joints are at zero."""
    robot = draw(strategies.robots(min_links=2, max_links=5, joint_types=joint_types))
    model = robot.models[0]
    names, graph = [link.name for link in model.links], FrameGraph(model)
    loops: list[Opaque] = []
    for number in range(draw(st.integers(1, 2))):
        word = draw(st.sampled_from(sorted(_TYPES)))
        kind = draw(st.sampled_from(_TYPES[word]))
        parent, child = draw(st.permutations(names))[:2]
        point = Pose() if kind == "fixed" else _rounded(draw(strategies.poses()))
        there = _rounded(graph.pose(child, parent).compose(Transform.from_pose(point)).to_pose())
        axis = draw(st.sampled_from(["", "1 0 0", "0 1 0", "0.6 0 -0.8"]))
        loops.append(_loop(word, kind, f"loop_{number}", axis, ((parent, there), (child, point))))
    model = model.copy(opaque=tuple(loops))
    return robot.copy(models=(model,), namespaces=(("drake", _DRAKE),))


@examples()
@given(robots_with_loops())
def test_a_robot_with_loops_comes_back_from_sdf(robot: Document) -> None:
    text = emit(robot, DiagnosticSink())
    there = twinform.convert(text.encode(), to="sdf")
    assert [each.rule.name for each in there.diagnostics if each.rule.name == "open-loop"] == []
    assert_round_trip(robot, via="sdf")


@pytest.mark.parametrize("version", ["1.5", "1.7"])
def test_loops_come_back_from_older_versions(version: str) -> None:
    @examples(0.1)
    @given(robots_with_loops(joint_types=(*_MOVING, "fixed")))
    def comes_back(robot: Document) -> None:
        assert_round_trip(robot, via="sdf", sdf_version=version)

    comes_back()


@st.composite
def robots_with_second_parents(draw: st.DrawFn) -> Document:
    """A robot with joints that have a link where another joint has it."""
    robot = draw(strategies.robots(min_links=3, max_links=5, joint_types=("revolute", "prismatic", "fixed")))
    model = robot.models[0]
    graph, joints = FrameGraph(model), list(model.joints)
    for number in range(draw(st.integers(1, 2))):
        parent, child = sorted(draw(st.permutations(range(len(model.links))))[:2])  # the joints go round in no circle
        one, other = f"link_{parent}", f"link_{child}"
        kind: JointType = "fixed" if draw(st.booleans()) else "continuous"
        placed = graph.pose(other, one).to_pose(one)
        axis = Axis(xyz=(0.0, 1.0, 0.0)) if kind == "continuous" else None
        joints.append(Joint(name=f"second_{number}", type=kind, parent=one, child=other, pose=placed, axis=axis))
    return robot.copy(models=(model.copy(joints=tuple(joints)),))


@examples(0.3)
@given(robots_with_second_parents())
def test_a_robot_with_second_parents_is_the_same_after_a_round_trip(robot: Document) -> None:
    text = emit(robot, DiagnosticSink())
    there = twinform.convert(text.encode(), to="sdf").text
    back = twinform.convert(there.encode(), to="urdf").text
    for made in (there, back):
        assert [each.message for each in twinform.diff(text.encode(), made.encode(), carriers=True).differences] == []
