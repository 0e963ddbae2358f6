"""What touches what, once the model that was written is back: bits and priorities that would be written again go.

A file says of each geom what it touches, by bits that the writer has computed of the model. The same bits computed
again say that nobody has edited them. What was edited stays with the geom as it is.
"""

from collections.abc import Mapping
from typing import NamedTuple, cast

from twinform.ir import Collision, Element, Link, Model, Node, Opaque, Surface, World, replace_fields, rewrite
from twinform.ir.kinematic_tree import KinematicTree
from twinform.ir.rewrite import ANYTHING
from twinform.ir.scopes import scoped_models
from twinform.passes.carriers.annotations import annotation, find_annotation, without_annotation
from twinform.passes.legalise.to_mjcf.contact_plan import ContactPlan
from twinform.passes.legalise.to_mjcf.friction import friction_of, friction_priorities
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.schemas import XmlElement

_TOUCH = "touch"
"""The annotation on a collision with the numbers of its geom, while the model is put together."""
_NUMBERS = {"contype": "1", "conaffinity": "1", "priority": "0"}
"""The attributes of a geom that the writer computes, with their defaults."""
_MASK = "collide_bitmask"


class Touch(NamedTuple):
    """What a geom is, what it touches, and whose friction counts."""

    contype: int
    conaffinity: int
    priority: int


def with_contacts(geoms: Mapping[str, XmlElement], collision: Collision) -> Collision:
    """The collision with an annotation of what its geom says of contacts, and without what is computed of that."""
    geom = geoms.get(collision.name or "")
    if geom is None:
        return collision
    note = annotation(_TOUCH, attributes={name: geom.get(name) or usual for name, usual in _NUMBERS.items()})
    surface = _without_mask(collision.surface) if collision.surface else None
    opaque = (note, *(left for part in collision.opaque if (left := _without_numbers(part)) is not None))
    return collision.copy(opaque=opaque, surface=surface)


def _without_mask(surface: Surface) -> Surface | None:
    opaque = tuple(part for part in surface.opaque if part.element is None or part.element.name != _MASK)
    # SDF has two coefficients, and MJCF one.
    mu2 = None if surface.mu2 == surface.mu else surface.mu2
    made = surface.copy(opaque=opaque, mu2=mu2)
    return None if made == Surface.unchecked() else made


def _without_numbers(part: Opaque) -> Opaque | None:
    if part.element is None or part.element.name != KEPT:
        return part
    children = tuple(left for each in part.element.children if (left := _bare(each)) is not None)
    return part.copy(element=part.element.copy(children=children)) if children else None


def _bare(element: Element) -> Element | None:
    if element.name != "geom":
        return element
    attributes = tuple(pair for pair in element.attributes if pair[0] not in _NUMBERS)
    return element.copy(attributes=attributes) if attributes or element.children else None


def settle_contacts(holder: Model | World) -> Model | World:
    """The model or world with the contacts of its geoms only where they are not those that it says itself."""
    tops = [("", holder)] if isinstance(holder, Model) else [(f"{each.name}::", each) for each in holder.models]
    models = [found for scope, model in tops for found in scoped_models(model, scope)]
    static = tuple(scope for scope, each in models if each.static)
    tree = KinematicTree(holder)
    links = frozenset(name for name in tree.links if name.startswith(static)) if static else frozenset[str]()
    plan = ContactPlan(holder, tree, links, is_of_mjcf=False)
    priorities = friction_priorities(each for link in tree.links.values() for each in link.collisions)
    names = {id(link): name for name, link in tree.links.items()}

    def settled(link: Link) -> Link:
        own = names.get(id(link), link.name)
        return replace_fields(link, collisions=tuple(settled_shape(own, each) for each in link.collisions))

    def settled_shape(link: str, collision: Collision) -> Collision:
        note = find_annotation(collision, _TOUCH)
        if note is None:
            return collision
        bits = plan.bits(link, collision)
        expected = Touch(*bits, priorities[friction_of(collision)])
        return _with_differences(without_annotation(collision, _TOUCH), note, expected)

    return _excluding(rewrite(holder, Link, settled, having=ANYTHING), plan)


def kept_apart(model: Model, root: XmlElement) -> Model:
    """A model of MJCF that does not touch itself, if all that its bits let touch is excluded in the file."""
    apart = model.copy(self_collide=False)
    plan = ContactPlan(apart, KinematicTree(apart), frozenset(), is_of_mjcf=True)
    written = {frozenset((each.get("body1"), each.get("body2"))) for each in root.iterfind("contact/exclude")}
    if not {frozenset[str | None](pair) for pair in plan.excluded} <= written:
        return model
    return cast("Model", _excluding(apart, plan))


def _with_differences(collision: Collision, note: Element, expected: Touch) -> Collision:
    written = dict(note.attributes)
    differing = [(name, written[name]) for name in _NUMBERS if float(written[name]) != getattr(expected, name)]
    if not differing:
        return collision
    if any(name != "priority" for name, _ in differing):  # both bits, since they are read together
        bits = [(name, written[name]) for name in ("contype", "conaffinity")]
        differing = [*bits, *(pair for pair in differing if pair[0] == "priority")]
    kept = Element.unchecked(name="geom", attributes=tuple(differing))
    part = Opaque.unchecked(element=Element.unchecked(name=KEPT, children=(kept,)))
    return collision.copy(opaque=(*collision.opaque, part))


def _excluding(holder: Model | World, plan: ContactPlan) -> Model | World:
    """The holder without exclusions that are computed of it."""
    pairs = {frozenset(pair) for pair in plan.excluded}

    def without(node: Node) -> Node:
        kept = [left for part in node.opaque if (left := without_pairs(part)) is not None]
        return replace_fields(node, opaque=tuple(kept))

    def without_pairs(part: Opaque) -> Opaque | None:
        if part.element is None or part.element.name != KEPT:
            return part
        sections = tuple(left for each in part.element.children if (left := rest(each)) is not None)
        return part.copy(element=part.element.copy(children=sections)) if sections else None

    def rest(section: Element) -> Element | None:
        if section.name != "contact":
            return section
        children = tuple(each for each in section.children if not is_computed(each))
        return section.copy(children=children) if children else None

    def is_computed(element: Element) -> bool:
        pair = frozenset((element.get("body1") or "", element.get("body2") or ""))
        return element.name == "exclude" and pair in pairs

    return cast("Model | World", without(holder))
