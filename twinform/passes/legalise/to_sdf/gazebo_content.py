"""SDF content of `<gazebo>` elements, read as the links, joints and shapes that they refer to."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Axis,
    Collision,
    Format,
    GazeboExtension,
    Inertial,
    Joint,
    Link,
    Model,
    Node,
    Visual,
    replace_fields,
)
from twinform.ir.defaults import direction, with_range
from twinform.ir.solids import with_written_defaults
from twinform.schemas import Context, element_xml, reader, table

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
    axis = joint.axis or Axis()
    update = {"xyz": direction(axis, Format.SDF), "limit": axis.limit and with_range(axis.limit, Format.SDF)}
    return joint.copy(axis=axis.copy(**update))
