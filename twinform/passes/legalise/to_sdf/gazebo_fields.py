"""Fields that `<gazebo>` elements set: by tags, and by SDF content that is read and merged into links and joints."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Axis,
    Collision,
    Dynamics,
    Element,
    Format,
    GazeboExtension,
    Inertial,
    Joint,
    Link,
    Material,
    Model,
    Node,
    Opaque,
    Script,
    Surface,
    Visual,
    replace_fields,
)
from twinform.ir.defaults import direction, with_range
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import field_value
from twinform.ir.rewrite import node_fields
from twinform.ir.solids import with_written_defaults
from twinform.passes.shared.gazebo_tags import SCRIPT_URI, Tag
from twinform.schemas import Context, element_xml, format_value, reader, table

Values = Iterable[tuple[Tag, Any]]


def set_model_fields(model: Model, values: Values) -> Model:
    """The model with the fields that tags set."""
    return model.copy(**{tag.field: value for tag, value in values})


def set_link_fields(link: Link, values: Values) -> Link:
    """The link with the fields that tags set as a whole."""
    update = {tag.field: value for tag, value in values if tag.target == "link"}
    return link.copy(**update) if update else link


def old_values(tag: Tag, link: Link) -> Iterator[object]:
    """What the shapes of a link have where a tag sets something; nothing for a tag about something else."""
    if tag.target == "surface":
        yield from (getattr(collision.surface, tag.field) for collision in link.collisions if collision.surface)
    elif tag.target == "collision":
        yield from (getattr(collision, tag.field) for collision in link.collisions)
    elif tag.target == "visual":
        scripts = (visual.material.script for visual in link.visuals if visual.material)
        yield from (script.name if script and script.uris == (SCRIPT_URI,) else script for script in scripts)


def set_visual(visual: Visual, values: Values) -> Visual:
    """The visual with the material that a tag names."""
    names = [str(value) for tag, value in values if tag.target == "visual" and value]
    if not names:
        return visual
    script = Script.unchecked(uris=(SCRIPT_URI,), name=names[-1])
    material = (visual.material or Material.unchecked()).copy(script=script)
    return visual.copy(material=material)


def set_collision(collision: Collision, values: Values) -> Collision:
    """The collision with the surface that tags describe."""
    own = {tag.field: value for tag, value in values if tag.target == "collision"}
    surface = {tag.field: value for tag, value in values if tag.target == "surface"}
    if surface:
        own["surface"] = (collision.surface or Surface.unchecked()).copy(**surface)
    return collision.copy(**own) if own else collision


def set_joint_fields(joint: Joint, values: Values) -> Joint:
    """The joint with the springs and the physics that tags describe."""
    springs = {tag.field: value for tag, value in values if tag.target == "dynamics"}
    if springs:
        axis = joint.axis or Axis.unchecked()
        dynamics = (axis.dynamics or Dynamics.unchecked()).copy(**springs)
        joint = joint.copy(axis=axis.copy(dynamics=dynamics))
    physics = [(tag.field, value) for tag, value in values if tag.target == "physics"]
    return merge(joint, {"opaque": (_physics(physics),)}, []) if physics else joint


def _physics(values: list[tuple[str, object]]) -> Opaque:
    """The `<physics>` of a joint from paths below it and their values."""
    inside: dict[str, Any] = {}
    for path, value in values:
        holder = inside
        *outer, last = path.split("/")
        for step in outer:
            holder = holder.setdefault(step, {})
        holder[last] = format_value(value)
    return Opaque.unchecked(element=_element("physics", inside))


def _element(name: str, inside: str | dict[str, Any]) -> Element:
    if isinstance(inside, str):
        return Element.unchecked(name=name, text=inside)
    return Element.unchecked(name=name, children=tuple([_element(*each) for each in inside.items()]))


AnyNode = TypeVar("AnyNode", bound=Node)

# Half of one inertia and half of another would be a body that nobody meant.
_WHOLE = frozenset({"inertial", "geometry", "pose", "surface"})
"""What makes sense only as it was written."""
REPLACING = frozenset({"material", "surface"})
"""Of these in `<visual>` and `<collision>` of `<gazebo>` libsdformat keeps the last (InsertSDFExtensionVisual)."""
_ONCE = frozenset({"physics"})
"""Elements without a typed form that may stand once."""


def merge(mine: AnyNode, fields: Mapping[str, Any], conflicts: list[str]) -> AnyNode:
    """The node with more fields. Of a field in both the first stays; `conflicts` gets its name."""
    update: dict[str, Any] = {}
    lists = node_fields(type(mine))
    for field, value in fields.items():
        old = field_value(mine, field)
        if field in NOT_CONTENT:
            continue
        if field == "opaque":
            update[field] = _join_opaque(mine.opaque, value)
        elif isinstance(old, tuple) and field in lists:
            update[field] = (*old, *value)
        elif old is None:
            update[field] = value
        elif isinstance(old, Node) and type(old) is type(value) and field not in _WHOLE:
            update[field] = merge(old, written(value), conflicts)
        elif old != value:
            conflicts.append(field)
    more: Mapping[str, str] = fields.get("spelling") or {}
    spelling = {**more, **(mine.spelling or {})}
    return mine.copy(**{**update, "spelling": spelling or None})


def written(node: Node) -> dict[str, Any]:
    """The fields that are written in a node, with how they are spelt and where they were read."""
    values = ((name, getattr(node, name)) for name in node.field_names)
    return {name: value for name, value in values if value is not None and value != ()}


def _join_opaque(mine: tuple[Opaque, ...], more: tuple[Opaque, ...]) -> tuple[Opaque, ...]:
    joined = list(mine)
    for part in more:
        once = part.element is not None and part.element.name in _ONCE
        place = next((i for i, old in enumerate(joined) if _are_alike(old, part)), None) if once else None
        element = joined[place].element if place is not None else None
        if place is None or element is None or part.element is None:
            joined.append(part)
        else:
            joined[place] = joined[place].copy(element=merge_elements(element, part.element))
    return tuple(joined)


def _are_alike(old: Opaque, new: Opaque) -> bool:
    if old.element is None or new.element is None or old.at != new.at:
        return False
    return old.element.name == new.element.name


def merge_elements(mine: Element, more: Element) -> Element:
    """The element with the children of another one that it lacks, all the way down."""
    children = list(mine.children)
    places = {child.name: place for place, child in reversed(list(enumerate(children)))}
    for child in more.children:
        if child.name not in places:
            places[child.name] = len(children)
            children.append(child)
        else:
            place = places[child.name]
            children[place] = merge_elements(children[place], child)
    return mine.copy(children=tuple(children))


_HAS_AXIS = frozenset({"revolute", "continuous", "prismatic", "screw"})
_REQUIRED = {"joint": {"type": "fixed"}}
_REQUIRED_CHILDREN = {"joint": ("parent", "child")}
_NODES: dict[str, type[Node]] = {"link": Link, "joint": Joint, "model": Model, "visual": Visual, "collision": Collision}
_GIVEN = frozenset({"source", "name", "type", "parent", "child"})
"""Fields that are there because the reader asks for them."""


def read_content(
    kind: str, name: str, robot: str, extensions: Iterable[GazeboExtension], sink: DiagnosticSink
) -> dict[str, Any]:
    """The fields that the content of extensions sets when it is read as the inside of an SDF element of a kind."""
    xml = etree.SubElement(etree.Element("robot", {"name": robot}), kind, {"name": name, **_REQUIRED.get(kind, {})})
    for tag in _REQUIRED_CHILDREN.get(kind, ()):
        etree.SubElement(xml, tag).text = name
    listed = list(extensions)
    for extension in listed:
        for element in extension.content:
            element_xml(element, xml)
    above = listed[0].source
    found = DiagnosticSink(file=above.file if above else sink.file, strict=sink.strict)
    context = Context(found, found.file, "sdf", table("sdf").newest, declared=False)
    data = reader("sdf", context.version).read(xml, context, kind, _NODES[kind], above)
    _report(found, f"{kind}[@name='{name}']", name if kind != "model" else "", sink)
    fields = [field for field in data if field not in _GIVEN]
    if sink.has_errors or not fields:
        return {}
    base: dict[str, Any] = {"name": name, **_REQUIRED.get(kind, {})}
    node = _NODES[kind].unchecked(**{**base, **{field: data[field] for field in fields}})
    made = {field: getattr(node, field) for field in fields}
    if isinstance(node, Link) and node.inertial is not None:
        made["inertial"] = _as_in_sdf(node.inertial)
    return made


def _report(found: DiagnosticSink, step: str, reference: str, sink: DiagnosticSink) -> None:
    """Report what was found in terms of the file: what was read as the element of `step` stands in a `<gazebo>`."""
    own = f"gazebo[@reference='{reference}']" if reference else "gazebo"
    for each in found.diagnostics:
        path = each.location.path.replace(step, own, 1)
        where = each.location._replace(path=path)
        sink.extend([replace(each, location=where)])


def with_mass(link: Link) -> Link:
    """The link with all of its inertial written: what it leaves out is 1 kg or 1 kg m^2 in SDF, and nothing in URDF."""
    # A link that only an extension has is SDF: Gazebo gives it 1 kg m^2 where nothing is written. A
    # token, as for links of URDF, would make another robot.
    return replace_fields(link, inertial=_as_in_sdf(link.inertial))


def _as_in_sdf(inertial: Inertial | None) -> Inertial:
    return inertial if inertial is not None and inertial.auto else with_written_defaults(inertial)


def with_axis(joint: Joint) -> Joint:
    """An axis that is not written is z in SDF and x in URDF; a limit that is not written is none at all, or zero."""
    if joint.type not in _HAS_AXIS:
        return joint
    axis = joint.axis or Axis.unchecked()
    update = {"xyz": direction(axis, Format.SDF), "limit": axis.limit and with_range(axis.limit, Format.SDF)}
    return joint.copy(axis=axis.copy(**update))
