"""Completion of elements and attributes: by the facts tables, with what has to be written in them."""

from collections.abc import Iterator

from twinform.ir.sensor import SENSOR_ELEMENTS
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS
from twinform.schemas import Fact, rows_by_name
from twinform.schemas.value_types import type_name
from twinform.server.completion.plugins import propose_attributes_of_parameter, propose_parameters
from twinform.server.completion.proposals import ITEM, ElementPlace, Proposal
from twinform.server.completion.xacro import propose_attributes_of_xacro, propose_blocks, propose_xacro
from twinform.server.document_names import definitions_in
from twinform.server.documents import TextDocument
from twinform.server.hover import text_of_row
from twinform.server.mapping import MappingRow
from twinform.server.schema import SchemaPlace, inside, is_of_xacro, place_in_gazebo
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_PARAMETERS = frozenset[str]().union(*SENSOR_ELEMENTS.values())
_MOVING = frozenset({"revolute", "continuous", "prismatic"})
_TWO_AXES = frozenset({"revolute2", "universal"})
_OF_JOINTS = {
    "axis": _MOVING | _TWO_AXES | {"planar", "screw", "gearbox"},
    "axis2": _TWO_AXES | {"gearbox"},
    "limit": _MOVING,
    "dynamics": _MOVING,
    "mimic": _MOVING,
    "calibration": _MOVING,
    "safety_controller": _MOVING,
    **{name: frozenset({"screw"}) for name in ("thread_pitch", "screw_thread_pitch")},
    **{name: frozenset({"gearbox"}) for name in ("gearbox_ratio", "gearbox_reference_body")},
}
"""The types of joints that have an element."""
# What libsdformat makes of URDF itself: written in <gazebo> as well, it would be there twice.
_MADE_OF_URDF = {
    "link": frozenset({"pose", "inertial", "frame"}),
    "joint": frozenset({"pose", "parent", "child", "axis", "axis2", "frame"}),
    "model": frozenset({"pose", "frame"}),
}


def propose_elements(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the elements that may stand in another."""
    document, parent = place.document, place.parent
    if parent.tag == "gazebo" and document.schema.format == "urdf":
        yield from _in_gazebo(place)
    else:
        yield from propose_blocks(place)
        found = document.schema.place(parent)
        yield from _elements_of(place, found) if found is not None else ()
    yield from propose_parameters(place)
    yield from propose_xacro(place)


def propose_roots(document: TextDocument) -> Iterator[Proposal]:
    """Propose the root of a document without one."""
    format_ = document.schema.format
    space = ' xmlns:xacro="http://www.ros.org/wiki/xacro"' if document.is_xacro else ""
    if format_ == "urdf":
        yield Proposal("robot", f'robot name="$1"{space}>\n  $0\n</robot>', ITEM.Class)
    elif format_ == "sdf":
        yield Proposal("sdf", f'sdf version="${{1:1.11}}"{space}>\n  $0\n</sdf>', ITEM.Class)
    elif format_ == "mjcf":
        yield Proposal("mujoco", 'mujoco model="$1">\n  <worldbody>\n    $0\n  </worldbody>\n</mujoco>', ITEM.Class)


def _elements_of(place: ElementPlace, holder: SchemaPlace, refused: frozenset[str] = frozenset()) -> Iterator[Proposal]:
    """Propose the elements of a row of a table that may still be written."""
    there = place.siblings
    taken = {fact.place for tag in there if (fact := _fact(holder, tag)) and fact.kind}
    refused = refused | _of_other_types(place.parent)
    for fact in rows_by_name(holder.known(), holder.version).values():
        row = holder.below(fact.name)
        if row is None or fact.is_attribute or fact.name in refused or not _is_usual(fact):
            continue
        is_other = fact.kind is not None and fact.place in taken and not (fact.repeats and fact.name in there)
        if (fact.repeats or fact.name not in there) and not is_other:
            new = fact.name if place.bare else _snippet(fact.name, row)
            yield Proposal(fact.name, new, ITEM.Class, detail_of(fact), text_of_row(row), _rank(fact))


def _fact(holder: SchemaPlace, tag: str) -> Fact | None:
    row = holder.below(tag)
    return row.fact if row is not None else None


def _of_other_types(parent: TolerantNode) -> frozenset[str]:
    """Return the elements that only sensors or joints of another type have."""
    own = parent.get("type") or ""
    if parent.tag == "sensor" and own in SENSOR_ELEMENTS:
        return _PARAMETERS - SENSOR_ELEMENTS[own]
    if parent.tag == "joint" and own and "$" not in own:
        return frozenset(name for name, types in _OF_JOINTS.items() if own not in types)
    return frozenset()


def _in_gazebo(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the tags that Gazebo reads, and what may be added to the link, joint or model of SDF."""
    reference, document = place.parent.get("reference"), place.document
    kinds = [name.kind for name in definitions_in(document) if name.text == reference]
    target = "model" if reference is None else "joint" if "joint" in kinds and "link" not in kinds else "link"
    tags = {"link": LINK_TAGS, "joint": JOINT_TAGS}.get(target, {})
    there = place.siblings
    for tag in tags:
        if tag not in there:
            yield Proposal(
                tag, tag if place.bare else f"{tag}>$1</{tag}>", ITEM.Property, "as Gazebo reads URDF", rank=0
            )
    yield from _elements_of(place, place_in_gazebo(target), _MADE_OF_URDF[target] | frozenset(tags))


def propose_attributes(
    session: Session, document: TextDocument, node: TolerantNode, *, named: bool
) -> Iterator[Proposal]:
    """Propose the attributes that an element does not have yet; `named` proposes the names only."""
    if is_of_xacro(node.tag):
        yield from propose_attributes_of_xacro(session, document, node, named=named)
        return
    place = document.schema.place(node)
    for fact in rows_by_name(place.known(), place.version).values() if place else ():
        name = fact.name.removeprefix("@")
        row = place.below(fact.name) if place and fact.is_attribute and _is_usual(fact) else None
        if row is not None and name not in node.attributes:
            new = name if named else _attribute(fact, 1)
            yield Proposal(name, new, ITEM.Property, detail_of(fact), text_of_row(row), _rank(fact))
    yield from propose_attributes_of_parameter(node, named=named)
    if node.parent is None and document.is_xacro and "xmlns:xacro" not in node.attributes:
        new = "xmlns:xacro" if named else 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
        yield Proposal("xmlns:xacro", new, ITEM.Property)


def _is_usual(fact: Fact) -> bool:
    """Whether a part is neither of a dialect, of which the checker makes a remark, nor deprecated."""
    return not fact.dialect and not fact.deprecated


def _snippet(name: str, row: MappingRow) -> str:
    """Make the snippet of an element without its `<`, with the required attributes."""
    place = inside(row)
    known = place.known()
    needed = [fact for fact in known if fact.is_attribute and fact.required]
    attributes = "".join(f" {_attribute(fact, number)}" for number, fact in enumerate(needed, 1))
    if row.fact.type is not None or place.inside.type is not None:
        return f"{name}{attributes}>${len(needed) + 1}</{name}>$0"
    if any(not fact.is_attribute for fact in known) or row.fact.any or place.inside.any:
        return f"{name}{attributes}>\n  $0\n</{name}>"
    return f"{name}{attributes}/>$0"


def _attribute(fact: Fact, number: int) -> str:
    name = fact.name.removeprefix("@")
    if fact.enum:
        return f'{name}="${{{number}|{",".join(fact.enum)}|}}"'
    return f'{name}="${number}"' if fact.default is None else f'{name}="${{{number}:{fact.default}}}"'


def _rank(fact: Fact) -> int:
    return 0 if fact.required else 1


def detail_of(fact: Fact) -> str:
    """Describe a part in a few words: its type, unit and default."""
    words = [type_name(fact.type or ""), fact.unit or "", f"default {fact.default}" if fact.default is not None else ""]
    words += ["required"] if fact.required else []
    return ", ".join(filter(None, words))
