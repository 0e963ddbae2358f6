"""Drake's own joints come back from SDF, where they are joints like others."""

from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.ir import Document, Element, Joint, Opaque, Pose
from twinform.schemas import format_value
from twinform.testing import assert_round_trip, strategies

_DRAKE = "http://drake.mit.edu"


def _element(joint: Joint, kind: str, damping: str) -> Element:
    pose = joint.pose or Pose()
    numbers = [(name, format_value(value)) for name in ("xyz", "rpy") if (value := getattr(pose, name)) is not None]
    children = [
        Element(name="parent", attributes=(("link", joint.parent or ""),)),
        Element(name="child", attributes=(("link", joint.child or ""),)),
        Element(name="origin", attributes=tuple(numbers)),
    ]
    if damping:
        words = " ".join([damping] * 3) if kind == "planar" else damping
        children.append(Element(name="dynamics", attributes=(("damping", words),)))
    if kind in {"planar", "screw"}:
        xyz = (joint.axis and joint.axis.xyz) or (0.0, 0.0, 1.0)
        children.append(Element(name="axis", attributes=(("xyz", format_value(xyz)),)))
    if kind == "screw":
        children.append(Element(name=f"{{{_DRAKE}}}screw_thread_pitch", attributes=(("value", "-0.002"),)))
    attributes = (("name", joint.name), ("type", kind))
    return Element(name=f"{{{_DRAKE}}}joint", attributes=attributes, children=tuple(children))


@st.composite
def robots_of_drake(draw: st.DrawFn) -> Document:
    """A robot some of whose joints only Drake has."""
    robot = draw(strategies.robots(min_links=2, max_links=5))
    model = robot.models[0]
    own = {joint.name for joint in model.joints if draw(st.booleans())}
    elements: list[Opaque] = []
    for joint in model.joints:
        if joint.name in own:
            kind = draw(st.sampled_from(["ball", "planar", "screw", "universal"]))
            elements.append(Opaque(element=_element(joint, kind, draw(st.sampled_from(["", "0.25"])))))
    joints = tuple(joint for joint in model.joints if joint.name not in own)
    links = (link.copy(pose=None) if link.pose and link.pose.relative_to in own else link for link in model.links)
    model = model.copy(links=tuple(links), joints=joints, opaque=tuple(elements))
    return robot.copy(models=(model,), namespaces=(("drake", _DRAKE),))


@examples(0.5)
@given(robots_of_drake())
def test_a_robot_of_drake_comes_back_from_sdf(robot: Document) -> None:
    assert_round_trip(robot, via="sdf")
