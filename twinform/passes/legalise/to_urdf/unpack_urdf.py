"""Parts of URDF that travelled through SDF in carriers stand where they stood."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import Notes
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Color, Element, Material, Model, Node, Opaque, Visual, map_children
from twinform.passes.legalise.carrier import is_carrier, unpack
from twinform.passes.legalise.model_pass import ModelPass
from twinform.schemas import Context, element_xml, reader, table

AnyNode = TypeVar("AnyNode", bound=Node)

_STAYS = frozenset({"joint", "link"})
"""Elements that became something else in SDF, so that putting them back beside it would say it twice."""


class UnpackUrdf(ModelPass):
    """Put what came from a URDF file back into the robot.

    Changes: 1. transmissions, ros2_control, safety limits and the like become what they were; 2. so do shared
    materials; 3. a visual has its own `<material>` again, if that still means the colour that the visual has.
    Never touches: renamed joints, frames and floating joints, whose carriers stay.
    Diagnostics: `stale-carrier` for a material that no longer fits.
    """

    name: ClassVar[str] = "unpack-urdf"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without carriers of what URDF can say."""
        if notes.has_errors:
            return model
        carried = [piece.element for part in model.opaque if is_carrier(part, "urdf") for piece in unpack(part)]
        materials = tuple(
            _material(element) for element in carried if element is not None and element.name == "material"
        )
        shared = {material.name: material.color for material in materials}
        model = map_children(model, lambda node: _unpack(node, shared, notes))
        kept = tuple(part for part in _native(model) if part.element is None or part.element.name != "material")
        return model.model_copy(update={"opaque": kept, "materials": (*model.materials, *materials)})


def _unpack(node: Node, shared: dict[str | None, Color | None], notes: Notes) -> Node:
    node = map_children(node, lambda child: _unpack(child, shared, notes))
    if not any(is_carrier(part, "urdf") for part in node.opaque):
        return node
    if isinstance(node, Visual):
        node = _with_material(node, shared, notes)
    return node.model_copy(update={"opaque": _native(node)})


def _native(node: Node) -> tuple[Opaque, ...]:
    """The opaque parts of a node, those of URDF out of their carriers where they can be."""
    return tuple(
        piece
        for part in node.opaque
        for piece in (unpack(part) if is_carrier(part, "urdf") and _fits(part) else (part,))
    )


def _fits(part: Opaque) -> bool:
    pieces = unpack(part)
    names = {piece.element.name for piece in pieces if piece.element}
    return not names & _STAYS and not any(piece.attribute and piece.attribute[0] == "name" for piece in pieces)


def _with_material(visual: Visual, shared: dict[str | None, Color | None], notes: Notes) -> Visual:
    """The visual with the material that it had; a colour that was edited since wins over the carried one."""
    for part in visual.opaque:
        pieces = [piece.element for piece in unpack(part) if piece.element] if is_carrier(part, "urdf") else []
        if [piece.name for piece in pieces] != ["material"]:
            continue
        rest = tuple(other for other in visual.opaque if other is not part)
        visual = visual.model_copy(update={"opaque": rest})
        material = _material(pieces[0])
        color = material.color or shared.get(material.name)
        if color == (visual.material.color if visual.material else None):
            return visual.model_copy(update={"material": material})
        message = f"visual {visual.name!r} had the material {material.name!r}, and has another colour now"
        notes.report(rules.STALE_CARRIER, message, visual.location, found=material.name)
    return visual


def _material(element: Element) -> Material:
    context = Context(Notes(), "", "urdf", table("urdf").newest)
    return Material.model_validate(reader("urdf", context.version).read(element_xml(element), context, "material"))
