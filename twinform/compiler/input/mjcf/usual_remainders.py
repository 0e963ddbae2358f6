"""Attributes of MJCF that are in every file which is written here, and say nothing of a robot that comes back."""

from collections.abc import Collection, Mapping, Sequence
from typing import TypeVar

from twinform.ir import Collision, Element, Model, Node, Opaque, Visual, replace_fields, rewrite
from twinform.passes.carriers.carriers import bits_of_ours
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.passes.legalise.to_mjcf.named_assets import names_of_assets

AnyNode = TypeVar("AnyNode", bound=Node)

# The groups of visuals and collisions, and what keeps MuJoCo from giving them a mass.
# Assets are named after files, and the reference of a spring without stiffness means nothing.
_USUAL: Mapping[str, Mapping[str, frozenset[str] | None]] = {
    "compiler": {
        "angle": frozenset({"radian"}),
        "autolimits": frozenset({"false"}),
        "inertiafromgeom": frozenset({"false"}),
    },
    "geom": {"group": frozenset({"2", "3"}), "density": frozenset({"0"}), "mesh": None, "hfield": None},
    "joint": {"springref": None},
    "mesh": {"inertia": frozenset({"shell"})},
    "site": {"group": frozenset({"4"})},
}


def without_usual(node: AnyNode) -> AnyNode:
    """The node without remainders of its own that only hold what is written for every robot."""
    if not node.opaque or not any(map(_is_kept, node.opaque)):
        return node
    return replace_fields(node, opaque=tuple(left for part in node.opaque if (left := _left_of(part)) is not None))


def without_named(node: AnyNode, names: Collection[tuple[str, str]]) -> AnyNode:
    """The node without usual remainders of its own, or named assets and equalities, which are written again."""
    node = without_usual(node)
    if not names:
        return node

    def left(part: Opaque) -> Opaque | None:
        if part.element is None or not _is_kept(part):
            return part
        sections = tuple(
            section.copy(children=_without_unused(section.children, names))
            if section.name in {"asset", "equality"}
            else section
            for section in part.element.children
        )
        return _left_of(part.copy(element=part.element.copy(children=sections)))

    return replace_fields(node, opaque=tuple(made for part in node.opaque if (made := left(part)) is not None))


def _without_unused(elements: Sequence[Element], names: Collection[tuple[str, str]]) -> tuple[Element, ...]:
    """The elements without those of these names; a texture that another material has is kept with that."""
    left = {id(each) for each in elements if _name_of(each) not in names}
    needed = {name for each in elements if id(each) in left for inner in each.walk() for name in names_of_assets(inner)}
    return tuple(each for each in elements if id(each) in left or _name_of(each) in needed)


def without_assets(model: Model, names: Collection[tuple[str, str]]) -> Model:
    """The model without usual remainders in it, and without those of named assets and equalities.

    A shape does not keep the name of a material of which nothing is left: what it looks like says all of it.
    """
    model = without_named(model, names)
    kept = [each for part in model.opaque if part.element and _is_kept(part) for each in part.element.children]
    known = {each.get("name") for section in kept if section.name == "asset" for each in section.children}

    def without_name(node: Node) -> Node:
        node = without_usual(node)
        if not isinstance(node, Visual | Collision):
            return node
        made = [part if part.element is None else _without_material(part, known) for part in node.opaque]
        return replace_fields(node, opaque=tuple(part for part in made if part is not None))

    return rewrite(model, Node, without_name, having=bits_of_ours("mjcf"))


def _without_material(part: Opaque, known: Collection[str | None]) -> Opaque | None:
    if part.element is None or not _is_kept(part):
        return part
    geoms = tuple(
        each.copy(attributes=tuple(pair for pair in each.attributes if pair[0] != "material" or pair[1] in known))
        for each in part.element.children
    )
    return _left_of(part.copy(element=part.element.copy(children=geoms)))


def _name_of(element: Element) -> tuple[str, str]:
    return element.name, element.get("name") or ""


def _is_kept(part: Opaque) -> bool:
    return part.element is not None and part.element.name == KEPT


def _left_of(part: Opaque) -> Opaque | None:
    if part.element is None or not _is_kept(part):
        return part
    left = _rest_of(part.element)
    return None if left is None else replace_fields(part, element=left)


def _rest_of(element: Element) -> Element | None:
    is_whole = element.name == "geom" and element.get("name") is not None  # SDF has no such shape
    usual = _USUAL.get("" if is_whole else element.name, {})
    attributes = tuple(pair for pair in element.attributes if not _is_usual(pair[1], usual.get(pair[0], frozenset())))
    children = tuple(left for each in element.children if (left := _rest_of(each)) is not None)
    return replace_fields(element, attributes=attributes, children=children) if attributes or children else None


def _is_usual(value: str, usual: frozenset[str] | None) -> bool:
    return usual is None or value in usual
