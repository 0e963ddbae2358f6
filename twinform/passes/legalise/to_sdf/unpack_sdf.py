"""Unpacking carriers of SDF parts into the nodes that they came from."""

from collections.abc import Iterable
from dataclasses import MISSING
from functools import partial
from typing import ClassVar, Literal, TypeVar, cast

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import (
    Color,
    Element,
    Joint,
    Link,
    Material,
    Model,
    Node,
    Opaque,
    Pose,
    Visual,
    census_of,
    map_children,
    rewrite,
)
from twinform.ir.node import NOT_CONTENT, are_nodes
from twinform.ir.record import fields_of
from twinform.passes.carriers.absorb import CarrierError, absorb, has_first, inside, is_repeated
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import bits_of_ours, is_carrier, is_memory, unpack
from twinform.passes.carriers.sdf_versions import VersionCondition
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import COLORS, SCRIPTS, urdf_color

AnyNode = TypeVar("AnyNode", bound=Node)

_HAVING = bits_of_ours("sdf", COLORS, SCRIPTS)
_ENDS = frozenset({"lower", "upper"})
_IDENTITY = Pose.unchecked(xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0))
"""As it is written: without it the pose behind it would be the one that counts."""
_ABOUT = NOT_CONTENT | {"opaque"}
"""Fields that are not compared: they are not content, or take any number of parts."""


class UnpackSdf(ModelPass):
    """Put what URDF could not express, and carriers of SDF hold, back where it stood.

    Changes: carriers of shapes, scripts, colors of light, surfaces, axes of fixed joints and the like become what they
    were, where the model leaves open what they say, in URDF and in `<gazebo>`: with `of` "bodies" those of the
    model and its links, with "parts" the others, and with "repeated-poses" those of a pose behind another one.
    Never touches: what does not fit; these carriers stay, and the last pass reports them.
    Diagnostics: `stale-carrier` for colors of a visual that has another one now.
    """

    name: ClassVar[str] = "unpack-sdf"
    of: Literal["bodies", "parts", "repeated-poses"] = "parts"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without carriers of what is left open."""
        if self.of == "repeated-poses":
            return rewrite(model, Node, _with_repeated_poses, having=_HAVING)
        if self.of == "parts":
            return map_children(model, lambda node: self._parts(node, sink))
        if not census_of(model) & _HAVING:
            return model
        model = _without_carriers(model)
        return model.copy(links=tuple(_without_carriers(link) for link in model.links))

    def _parts(self, node: Node, sink: DiagnosticSink) -> Node:
        if not census_of(node) & _HAVING:
            return node
        if isinstance(node, Link):
            return map_children(node, lambda child: self._parts(child, sink))
        if isinstance(node, Visual):
            node = _with_scripts(_with_colors(node, sink), sink)
        return _without_carriers(node)


def _without_carriers(node: AnyNode) -> AnyNode:
    carriers = [part for part in node.opaque if is_carrier(part, "sdf") and not _is_repeated_pose(part)]
    if not carriers:
        return node
    node = node.copy(opaque=tuple(part for part in node.opaque if part not in carriers))
    for carrier in sorted(carriers, key=partial(_is_second, node)):  # after what it repeats, which may travel too
        if _is_blank_pose(carrier):
            continue
        # What the file says counts. A carrier adds only where the file leaves something open; a
        # carrier that overruled an edit would undo it silently.
        more = None if is_memory(carrier) or _is_overruled(carrier, node) else _absorb_carrier(node, carrier)
        node = node.copy(opaque=(*node.opaque, carrier)) if more is None else more
    return node


def _with_repeated_poses(node: Node) -> Node:
    """The node with poses of which readers see none, behind the one that they take, which is written for that."""
    if not any(map(_is_repeated_pose, node.opaque)) or not hasattr(node, "pose"):
        return node
    parts = tuple(piece for part in node.opaque for piece in (unpack(part) if _is_repeated_pose(part) else (part,)))
    pose = getattr(node, "pose", None)
    return node.copy(pose=_IDENTITY if pose in (None, Pose.unchecked()) else pose, opaque=parts)


def _is_repeated_pose(part: Opaque) -> bool:
    element = part.element
    if not is_carrier(part, "sdf") or element is None or element.get("index") is None or element.get("at"):
        return False
    return bool(element.children) and all(child.name == "pose" for child in element.children)


def _is_blank_pose(carrier: Opaque) -> bool:
    """Whether a carrier holds nothing but an empty pose, which the link has anyway."""
    return all(
        piece.element is not None and piece.element == Element.unchecked(name="pose") for piece in unpack(carrier)
    )


def _is_overruled(carrier: Opaque, node: Node) -> bool:
    """Whether URDF means another value by leaving an element out.

    Limits of a joint that turns, a whole material, or the first of two things, of which the carrier has the second.
    """
    at = (carrier.element.get("at") or "") if carrier.element else ""
    named = {piece.element.name for piece in unpack(carrier) if piece.element}
    if carrier.element and carrier.element.get("index") is not None:
        holder = inside(node, at)
        again = at or isinstance(node, Joint) or any(is_repeated(piece, node) for piece in unpack(carrier))
        return bool(again) and not (holder and all(_is_there(holder, name) for name in named))
    if isinstance(node, Joint):
        return at == "axis/limit" and node.type != "continuous" and bool(named & _ENDS)
    # The rest of a material (a script, PBR maps) goes with its color. Where somebody took the
    # material away, the rest must not bring a look back that nobody sees in the file.
    return isinstance(node, Visual) and at.startswith("material") and not _has_look(node.material)


def _is_second(node: Node, carrier: Opaque) -> bool:
    """Whether the content of a carrier repeats an element of the node."""
    has_index = carrier.element is not None and carrier.element.get("index") is not None
    return has_index and any(is_repeated(piece, node) for piece in unpack(carrier))


def _is_there(holder: Node, name: str) -> bool:
    """Whether a node has the element that another one repeats; a material of URDF may be no more than a name."""
    if isinstance(holder, Visual) and name == "material":
        return _has_look(holder.material)
    return has_first(holder, name)


def _has_look(material: Material | None) -> bool:
    """Whether URDF has the appearance, beside which there may be more to say."""
    other = (material.ambient, material.diffuse, material.albedo_map, material.script) if material else ()
    return any(each is not None for each in other)


def _with_colors(visual: Visual, sink: DiagnosticSink) -> Visual:
    """The visual with the two colors that URDF has one for, unless that one was changed since."""
    found = find_annotation(visual, COLORS)
    material = visual.material
    if found is None:
        return visual
    visual = without_annotation(visual, COLORS)
    try:
        of, ambient, diffuse = (_read_color(found.get(name)) for name in ("of", "ambient", "diffuse"))
    except ValueError as error:
        of = ambient = diffuse = None
        sink.report(STALE_CARRIER, f"the kept colors of visual {visual.name!r} are invalid: {error}", visual.location)
    # URDF has one color for two. The second travels with the one that URDF has, and counts while
    # that is what it was.
    if material is None or material.diffuse is None or of is None or urdf_color(material.diffuse) != of:
        message = f"visual {visual.name!r} had two colors in SDF, and its color was edited since"
        sink.report(STALE_CARRIER, message, visual.location, found=found.get("of") or "")
        return visual
    other = {name: color for name, color in (("ambient", ambient), ("diffuse", diffuse)) if color is not None}
    return visual.copy(material=material.copy(**{n: c or None for n, c in other.items()}))


def _with_scripts(visual: Visual, sink: DiagnosticSink) -> Visual:
    """The visual whose material of Gazebo Classic is in files of its own, unless it has none any more."""
    found = find_annotation(visual, SCRIPTS)
    if found is None:
        return visual
    visual = without_annotation(visual, SCRIPTS)
    script = visual.material.script if visual.material else None
    if visual.material is None or script is None:
        message = f"visual {visual.name!r} had a material of Gazebo Classic in SDF, and has none now"
        sink.report(STALE_CARRIER, message, visual.location, found=found.text or "")
        return visual
    uris = tuple(line.strip() for line in (found.text or "").splitlines() if line.strip())
    script = script.copy(uris=uris)
    return visual.copy(material=visual.material.copy(script=script))


def _read_color(text: str | None) -> Color | None:
    """The color in an annotation: empty for a color that SDF did not write, None without the attribute."""
    if text is None:
        return None
    return tuple(float(part) for part in text.split())


def _absorb_all(node: AnyNode, carriers: Iterable[Opaque]) -> AnyNode:
    """The node with what is in the carriers.

    Raises:
        CarrierError: one of them does not fit.
    """
    for carrier in carriers:
        index = carrier.element.get("index") if carrier.element else None
        condition = VersionCondition(index=int(index) if index and index.isdecimal() else None)
        node = absorb(node, unpack(carrier), condition)
    return node


def _absorb_carrier(node: AnyNode, carrier: Opaque) -> AnyNode | None:
    """The node with the content of a carrier; None where the node states it already, or cannot hold it."""
    try:
        if carrier.element and carrier.element.get("at") and carrier.element.get("index") is not None:
            return _absorb_all(node, [carrier])
        other = _absorb_all(node.copy(**_defaults(node)), [carrier])
        has_pose = getattr(other, "pose", None) is not None
        return _absorb_all(node, [carrier]) if not has_pose and _is_new(other, node) else None
    except CarrierError:
        return None


def _defaults(node: Node) -> dict[str, object]:
    """The field values of an empty node."""
    fields = fields_of(type(node)).items()
    return {name: field.default for name, field in fields if name not in _ABOUT and field.default is not MISSING}


def _is_new(other: Node, node: Node) -> bool:
    """Whether no field of a node contradicts the same field of another node."""
    return all(
        _goes_with(getattr(other, name), getattr(node, name), default) for name, default in _defaults(node).items()
    )


def _goes_with(other: object, here: object, default: object) -> bool:
    if other == default or here in (default, other) or are_nodes(other):
        return True
    return isinstance(other, Node) and type(other) is type(here) and _is_new(other, cast("Node", here))
