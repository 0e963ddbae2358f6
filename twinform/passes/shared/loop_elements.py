"""Elements of URDF that close a loop, such as Isaac's `<loop_joint>`, as joints of SDF, and joints as such elements."""

import math
from collections.abc import Container, Iterable, Iterator, Mapping

from twinform.ir import Axis, Element, Format, Joint
from twinform.ir.defaults import AXIS
from twinform.ir.foreign_joints import (
    LOOP_FORMS,
    EndForm,
    ForeignJoint,
    LoopForm,
    child_of,
    usual_word,
)
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.joint import JointType
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.annotations import EXTENSION, find_annotation, with_annotation, without_annotation
from twinform.passes.shared.poses import offset_attributes, read_offset, read_vector
from twinform.schemas import clark_name, format_value

_TYPES: Mapping[str, JointType] = {
    "ball": "ball",
    "spherical": "ball",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "universal": "universal",
    "fixed": "fixed",
}
"""What the types of such joints are called in SDF."""
_MOVING = frozenset({"revolute", "prismatic", "universal"})
_TURNED = frozenset({"prismatic", "fixed"})
"""The types for which it matters how the ends are turned."""
_APART = 1e-6
"""How far the ends of a loop may be from each other, in m and rad, to count as one place: files round numbers."""
_DEFAULT = AXIS[Format.URDF]


class OpenLoopError(ValueError):
    """SDF has no joint for an element that closes a loop; the message says why."""


def read_loop(foreign: ForeignJoint, name: str, graph: FrameGraph, links: Container[str], *, annotated: bool) -> Joint:
    """The joint of SDF, with this name, that an element describes.

    Where it is `annotated`, the annotation names the element, and where the frame of its parent's end is.

    Raises:
        OpenLoopError: SDF has no such joint.
        FrameError: a link is not known.
    """
    element, form, parent, child = foreign.part.element, foreign.form, foreign.joint.parent, foreign.joint.child
    if element is None or form is None or parent is None or child is None or child not in links:
        raise OpenLoopError("its second end is on no link")
    word = element.get("type") or ("" if form.attributes else "ball")
    kind = _kind(word, element, form)
    (one, axis), (other, axis2) = _read_end(element, form.parent), _read_end(element, form.child)
    placed = graph.pose(parent, child) if parent in links else graph.pose(WORLD, child, kind="world")
    # The end on the parent in the frame of the end on the child, which is that of the joint in SDF.
    offset = other.inverse().compose(placed).compose(one)
    require_closed(offset, kind)
    offset = Transform.from_pose(offset.to_pose())  # without the noise of composing
    joint = Joint.unchecked(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        pose=None if other.is_identity else other.to_pose(),
        axis=_turned_axis(offset, axis or (_DEFAULT if kind in _MOVING else None)),
        axis2=_turned_axis(Transform(), axis2 or _DEFAULT) if kind == "universal" else None,
        source=foreign.joint.source,
    )
    said = {"as": foreign.word, "type": None if word == kind else word, **offset_attributes(offset)}
    return with_annotation(joint, EXTENSION, attributes=said) if annotated else joint


def behind_tree(loops: Iterable[Joint], joints: Iterable[Joint]) -> Iterator[Joint]:
    """Yield joints that close loops with the line of the joint that moves their child, where that comes later.

    Joints are written in the order of their lines, and readers of SDF take the first one of a link for the tree.
    """
    moving = {joint.child: joint.source for joint in joints if joint.source is not None}
    for loop in loops:
        own, tree = loop.source, moving.get(loop.child)
        is_early = own is not None and tree is not None and own.file == tree.file and own.line < tree.line
        yield loop.copy(source=own._replace(line=tree.line)) if own and tree and is_early else loop


def write_loop(joint: Joint, in_parent: Transform, in_child: Transform) -> Element | None:
    """The element that an annotation names, for a joint at these places in its links; None if it would say less."""
    found = find_annotation(joint, EXTENSION)
    word = (found and found.get("as")) or ""
    form = LOOP_FORMS.get(word)
    if found is None or form is None or not _says_no_more(joint, form):
        return None
    try:
        offset = read_offset(found)
    except ValueError:
        return None
    kind = found.get("type") or ""
    own = (("name", joint.name), ("type", kind if _TYPES.get(kind) == joint.type else joint.type))
    axis = joint.axis and joint.axis.xyz and offset.inverse().rotate(joint.axis.xyz)
    parent = _write_end(form.parent, joint.parent or "", in_parent.compose(offset), axis)
    child = _write_end(form.child, joint.child or "", in_child, joint.axis2 and joint.axis2.xyz)
    own = tuple(pair for pair in own if pair[0] in form.attributes)
    return Element.unchecked(name=clark_name(word), attributes=own, children=(*parent, *child))


def _kind(word: str, element: Element, form: LoopForm) -> JointType:
    """The type in SDF of a joint that an element describes, if that says nothing else."""
    kind = _TYPES.get(word)
    if kind is None or (kind == "universal" and not form.child.axis):
        raise OpenLoopError(f"its type is {word!r}")
    axis, axis2 = (end.axis and child_of(element, end.axis) for end in (form.parent, form.child))
    if not _is_plain(element, form) or (axis and kind == "fixed") or (axis2 and kind != "universal"):
        raise OpenLoopError("it says more than such a joint has")
    return kind


def _is_plain(element: Element, form: LoopForm) -> bool:
    """Whether an element has nothing in it but what its form has, and each of that once."""
    ends = (form.parent, form.child)
    known: dict[str, set[str]] = {end.axis: {"xyz"} for end in ends}
    for end in ends:
        known.setdefault(end.link, set()).add(end.attribute)
        known.setdefault(end.place, set()).update(_PLACES)
    words = [usual_word(child) for child in element.children]
    return (
        len(set(words)) == len(words)
        and {name for name, _ in element.attributes} <= {*form.attributes}
        and not any(each.text or each.tail for each in element.walk())
        and all(
            word in known and {name for name, _ in child.attributes} <= known[word] and not child.children
            for word, child in zip(words, element.children, strict=True)
        )
    )


_PLACES = ("xyz", "rpy", "value")


def _read_end(element: Element, end: EndForm) -> tuple[Transform, Vector3 | None]:
    """The point of an end in the frame of its link, and its axis in the frame of the point, if one is written."""
    place = child_of(element, end.place)
    axis = child_of(element, end.axis) if end.axis else None
    try:
        value = place and place.get("value")
        place = place.copy(attributes=(("xyz", value),)) if place and value else place
        written = axis and read_vector(axis.get("xyz") or "1 0 0")
        point = read_offset(place) if place else Transform()
    except ValueError as error:
        raise OpenLoopError("it has numbers that are none") from error
    if written and not any(written):
        raise OpenLoopError("its axis points nowhere")
    return point, written or None


def require_closed(offset: Transform, kind: JointType) -> None:
    """Require the ends of a loop to be in one place, one being at `offset` from the other.

    Raises:
        OpenLoopError: they are not.
    """
    gap = math.hypot(*offset.translation)
    if gap > _APART:
        raise OpenLoopError(f"its ends are {gap:.3g} m apart where all joints are at zero")
    turn = 2 * math.acos(min(1.0, abs(offset.quaternion()[3])))
    if kind in _TURNED and turn > _APART:
        raise OpenLoopError(f"its ends are turned by {turn:.3g} rad where all joints are at zero")


def _turned_axis(turn: Transform, xyz: Vector3 | None) -> Axis | None:
    return None if xyz is None else Axis.unchecked(xyz=rounded(turn.rotate(xyz)))


def _says_no_more(joint: Joint, form: LoopForm) -> bool:
    """Whether a joint has nothing that an element of this form could not say."""
    types = {*_TYPES.values()} if form.attributes else {"ball"}
    if joint.type not in types or (joint.type == "universal" and not form.child.axis):
        return False
    bare = Joint.unchecked(
        name=joint.name,
        type=joint.type,
        parent=joint.parent,
        child=joint.child,
        pose=joint.pose,
        axis=joint.axis and Axis.unchecked(xyz=joint.axis.xyz),
        axis2=joint.axis2 and Axis.unchecked(xyz=joint.axis2.xyz),
    )
    return without_annotation(joint, EXTENSION) == bare


def _write_end(end: EndForm, link: str, point: Transform, axis: Vector3 | None) -> Iterator[Element]:
    named = (end.attribute, link)
    moved = {"xyz": any(point.translation), "rpy": not point.is_unturned}
    place = [(name, text) for name, text in offset_attributes(point).items() if text is not None and moved[name]]
    if end.place == end.link:
        yield Element.unchecked(name=clark_name(end.link), attributes=(named, *place))
    else:
        yield Element.unchecked(name=clark_name(end.link), attributes=(named,))
        if end.place.startswith("drake:"):
            place = [("value", dict(place).get("xyz", "0 0 0"))]
        if place:
            yield Element.unchecked(name=clark_name(end.place), attributes=tuple(place))
    if end.axis and axis and (written := rounded(axis)) != _DEFAULT:
        yield Element.unchecked(name=end.axis, attributes=(("xyz", format_value(written)),))
