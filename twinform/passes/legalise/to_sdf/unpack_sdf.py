"""What SDF says of shapes and fixed joints, and URDF does not, stands where it stood."""

from collections.abc import Iterable
from typing import ClassVar, TypeVar, cast

from twinform.diagnostics import Notes
from twinform.ir import Collision, Color, Joint, Link, Material, Model, Node, Opaque, Visual, map_children
from twinform.passes.legalise.carrier import is_carrier, unpack
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.sdf_versions.absorb import CarrierError, absorb
from twinform.passes.legalise.sdf_versions.carriers import Terms
from twinform.passes.legalise.urdf_color import urdf_color
from twinform.schemas import parse_version, table

AnyNode = TypeVar("AnyNode", bound=Node)

_COLOURS = ("ambient", "diffuse")
"""What URDF has one colour for."""
_ABOUT = frozenset({"opaque", "source", "spelling"})
"""Fields in which a node says nothing of its own, or one thing beside others."""


class UnpackSdf(ModelPass):
    """Put what came from an SDF file back into visuals, collisions and fixed joints.

    Changes: carriers of scripts, colours of light, surfaces, axes of fixed joints and the like become what they were,
    where the model leaves open what they say, in words of URDF and in `<gazebo>`. With `carriers` false, the others go.
    Never touches: poses, which are in the frames of the file that they came from; joints that move; what does not fit.
    These carriers stay.
    Diagnostics: none.
    """

    name: ClassVar[str] = "unpack-sdf"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without carriers of what is left open."""
        return map_children(model, self._unpacked)

    def _unpacked(self, node: Node) -> Node:
        if isinstance(node, Link):
            return map_children(node, self._unpacked)
        return self._without_carriers(node) if is_looked_into(node) else node

    def _without_carriers(self, node: Node) -> Node:
        carriers = [part for part in node.opaque if is_carrier(part, "sdf")]
        if not carriers:
            return node
        node = node.model_copy(update={"opaque": tuple(part for part in node.opaque if not is_carrier(part, "sdf"))})
        if isinstance(node, Visual):
            node, carriers = _with_colours(node, carriers)
        for carrier in carriers:
            more = _with(node, carrier)
            if more is None and self.carriers:
                more = node.model_copy(update={"opaque": (*node.opaque, carrier)})
            node = more or node
        return node


def is_looked_into(node: Node) -> bool:
    """Whether its carriers of SDF may come out once all that URDF says is said."""
    return isinstance(node, Visual | Collision) or (isinstance(node, Joint) and node.type == "fixed")


def _with_colours(visual: Visual, carriers: list[Opaque]) -> tuple[Visual, list[Opaque]]:
    """The visual with the two colours that URDF has one for, unless that one was changed since, and what is left."""
    colours = [carrier for carrier in carriers if _is_colour(carrier)]
    empty = visual.model_copy(update={"material": Material()})
    material = visual.material or Material()
    try:
        said = _absorbed(empty, colours).material or Material()
        if not _are_same(said.diffuse or said.ambient, material.diffuse):
            return visual, carriers
        material = material.model_copy(update={"ambient": None, "diffuse": None})
        visual = _absorbed(visual.model_copy(update={"material": material}), colours)
    except CarrierError:
        return visual, carriers
    return visual, [carrier for carrier in carriers if carrier not in colours]


def _is_colour(carrier: Opaque) -> bool:
    pieces = unpack(carrier)
    return all(piece.at == "material" and piece.element and piece.element.name in _COLOURS for piece in pieces)


def _are_same(said: Color | None, here: Color | None) -> bool:
    """Whether two colours are one in URDF."""
    return said is not None and here is not None and urdf_color(said) == urdf_color(here)


def _absorbed(node: AnyNode, carriers: Iterable[Opaque]) -> AnyNode:
    """The node with what is in the carriers.

    Raises:
        CarrierError: one of them does not fit.
    """
    pieces = tuple(piece for carrier in carriers for piece in unpack(carrier))
    return absorb(node, pieces, Terms(), parse_version(table("sdf").versions[-1]))


def _with(node: AnyNode, carrier: Opaque) -> AnyNode | None:
    """The node with what is in a carrier; None where it says that already, or cannot."""
    try:
        said = _absorbed(node.model_copy(update=_defaults(node)), [carrier])
        has_pose = said.__dict__["pose"] is not None
        return _absorbed(node, [carrier]) if not has_pose and _is_new(said, node) else None
    except CarrierError:
        return None


def _defaults(node: Node) -> dict[str, object]:
    """What the fields hold of a node that says nothing."""
    fields = type(node).model_fields.items()
    return {name: field.default for name, field in fields if name not in _ABOUT and not field.is_required()}


def _is_new(said: Node, node: Node) -> bool:
    """Whether a node says nothing else where another one of its kind says something."""
    return all(
        _goes_with(getattr(said, name), getattr(node, name), default) for name, default in _defaults(node).items()
    )


def _goes_with(said: object, here: object, default: object) -> bool:
    if said == default or here in (default, said):
        return True
    return isinstance(said, Node) and type(said) is type(here) and _is_new(said, cast("Node", here))
