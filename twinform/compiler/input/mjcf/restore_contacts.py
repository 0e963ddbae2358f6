"""What touches what, once the model that was written is back: bits and priorities that would be written again go.

A file says of each geom what it touches, by bits that the writer has computed of the model. The same bits computed
again say that nobody has edited them. What was edited stays with the geom as it is.
"""

from collections.abc import Collection
from typing import NamedTuple, cast

from twinform.compiler.input.mjcf.links_that_touch import links_that_touch
from twinform.compiler.input.mjcf.renamed_parts import name_in_file
from twinform.ir import Collision, Element, Link, Model, Node, Opaque, Surface, World, replace_fields, rewrite
from twinform.ir.kinematic_tree import KinematicTree
from twinform.ir.rewrite import ANYTHING
from twinform.ir.scopes import scoped_models
from twinform.passes.carriers.annotations import annotation, find_annotation, without_annotation
from twinform.passes.legalise.to_mjcf.contact_plan import MASKS, Bits, ContactPlan, mask_of
from twinform.passes.legalise.to_mjcf.friction import friction_of, friction_priorities
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT, kept_elements
from twinform.schemas import XmlElement

_TOUCH = "touch"
"""The annotation on a collision with the numbers of its geom, while the model is put together."""
_NUMBERS = {"contype": "1", "conaffinity": "1", "priority": "0"}
"""The attributes of a geom that the writer computes, with their defaults."""
_MASK = MASKS[0]


class Touch(NamedTuple):
    """What a geom is, what it touches, and whose friction counts."""

    contype: int
    conaffinity: int
    priority: int


def with_contacts(collision: Collision) -> Collision:
    """The collision with an annotation of what its geom says of contacts, and without what is computed of that."""
    note = annotation(_TOUCH, attributes=_numbers_of(collision))
    surface = _without_mask(collision.surface) if collision.surface else None
    opaque = (note, *(left for part in collision.opaque if (left := _without_numbers(part)) is not None))
    return collision.copy(opaque=opaque, surface=surface)


def _numbers_of(collision: Collision) -> dict[str, str]:
    """What the geom of a collision says of contacts: two numbers that are alike are a mask, and others are kept."""
    mask = mask_of(collision, _MASK)
    alike = {} if mask is None else {"contype": str(mask), "conaffinity": str(mask)}
    kept = {name: value for each in kept_elements(collision) if each.name == "geom" for name, value in each.attributes}
    usual = _NUMBERS if kept.keys() & alike.keys() else {**_NUMBERS, **alike}
    return {name: kept.get(name) or number for name, number in usual.items()}


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
    """The model or world with the contacts of its geoms only where they are not those that it says itself.

    Links that touch in the file, and in SDF did not, collide with their own model.
    """
    contacts = _HolderContacts(holder)
    touching = contacts.touching_links()
    return (_HolderContacts(contacts.with_self_collision(touching)) if touching else contacts).without_computed()


class _HolderContacts:
    """What a model or world says of contacts itself, beside what stands in the file."""

    def __init__(self, holder: Model | World) -> None:
        self.holder = holder
        tops = [("", holder)] if isinstance(holder, Model) else [(f"{each.name}::", each) for each in holder.models]
        models = [found for scope, model in tops for found in scoped_models(model, scope)]
        static = tuple(scope for scope, each in models if each.static)
        self.tree = tree = KinematicTree(holder)
        self.static = frozenset(name for name in tree.links if name.startswith(static)) if static else frozenset[str]()
        self.plan = ContactPlan(holder, tree, self.static, is_of_mjcf=False)
        self.names = {id(link): name for name, link in tree.links.items()}

    def touching_links(self) -> set[str]:
        """The links that have to collide with their own model, for all to touch that does in the file."""
        excluded = _exclusions(self.holder)
        if excluded.issuperset(map(frozenset, self.plan.excluded)) and not any(map(self._is_edited, self.tree.links)):
            return set()
        bits = {name: frozenset(map(_written_bits, link.collisions)) for name, link in self.tree.links.items()}
        return set(links_that_touch(self.plan, bits, excluded))

    def _is_edited(self, name: str) -> bool:
        """Whether the geoms of a link have other bits than it gives them."""
        collisions = self.tree.links[name].collisions
        return any(_written_bits(each) not in {None, self.plan.bits(name, each)} for each in collisions)

    def with_self_collision(self, names: Collection[str]) -> Model | World:
        """The holder whose links of these names collide with their own model."""

        def told(link: Link) -> Link:
            return link.copy(self_collide=True) if self.names.get(id(link), link.name) in names else link

        return rewrite(self.holder, Link, told, having=ANYTHING)

    def without_computed(self) -> Model | World:
        """The holder, whose geoms keep what it does not say of their contacts."""
        priorities = friction_priorities(each for link in self.tree.links.values() for each in link.collisions)

        def settled(link: Link) -> Link:
            own = self.names.get(id(link), link.name)
            return replace_fields(link, collisions=tuple(settled_shape(own, each) for each in link.collisions))

        def settled_shape(link: str, collision: Collision) -> Collision:
            note = find_annotation(collision, _TOUCH)
            if note is None:
                return collision
            expected = Touch(*self.plan.bits(link, collision), priorities[friction_of(collision)])
            return _with_differences(without_annotation(collision, _TOUCH), note, expected)

        made = rewrite(self.holder, Link, settled, having=ANYTHING)
        if not any(map(self._is_edited, self.tree.links)):
            return _excluding(made, self.plan)
        return _excluding(made, ContactPlan(made, KinematicTree(made), self.static, is_of_mjcf=False))


def _written_bits(collision: Collision) -> Bits | None:
    """The bits of the geom of a collision in the file; None where it has none there."""
    note = find_annotation(collision, _TOUCH)
    return None if note is None else Bits(*(int(float(note.get(name) or "0")) for name in Bits._fields))


def _exclusions(holder: Model | World) -> set[frozenset[str]]:
    """The pairs of bodies that the file excludes."""
    sections = (each for each in kept_elements(holder) if each.name == "contact")
    excluding = (each for section in sections for each in section.children if each.name == "exclude")
    return {frozenset((each.get("body1") or "", each.get("body2") or "")) for each in excluding}


def kept_apart(model: Model, root: XmlElement) -> Model:
    """A model of MJCF that does not touch itself, if all that its bits let touch is excluded in the file."""
    apart = model.copy(self_collide=False)
    plan = ContactPlan(apart, KinematicTree(apart), frozenset(), is_of_mjcf=True)
    written = {frozenset((each.get("body1"), each.get("body2"))) for each in root.iterfind("contact/exclude")}
    names = {each.name: name_in_file(each) for each in model.links}
    if not {frozenset(names.get(each, each) for each in pair) for pair in plan.excluded} <= written:
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
