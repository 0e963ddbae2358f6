"""Walking and rewriting trees of nodes. What a change leaves alone stays the same object, in whole or in parts.

The census of a subtree has bits for what is somewhere in it, and is cached, so that passes skip what does not concern
them. There is a bit for each class of nodes, one for each field that few models write, and some for untyped parts.
"""

from collections.abc import Callable, Iterable, Iterator
from functools import cache, lru_cache, partial
from operator import is_
from typing import Any, NamedTuple, Self, TypeVar, get_args
from zlib import crc32

from twinform.ir.document import World
from twinform.ir.element import Element, Opaque
from twinform.ir.geometry import Capsule
from twinform.ir.joint import Axis, Dynamics, Joint, Limit
from twinform.ir.link import Inertial, Link
from twinform.ir.model import GazeboExtension, Include, Model
from twinform.ir.node import Node
from twinform.ir.pose import Frame, Pose
from twinform.ir.record import Record, Sourced, field_values, fields_of
from twinform.ir.sensor import Light, Sensor
from twinform.ir.visual import Material, Visual

AnyPart = TypeVar("AnyPart", bound=Sourced)
AnyNode = TypeVar("AnyNode", bound=Node)
Wanted = TypeVar("Wanted", bound=Node)


# One class at a time: a mapping `{Joint: f, Link: g}` cannot be typed so that each handler takes
# what its key is, and a visitor finds its methods by names that no checker reads. Of some forty
# callers three had two classes.
def rewrite(
    node: AnyNode,
    kind: type[Wanted],
    change: Callable[[Wanted], Wanted],
    *,
    having: int | None = None,
) -> AnyNode:
    """Change every node of one class in a tree, from the inside out, in the order of fields.

    So `change` sees a node in which all is changed already. A node without any of the bits `having` in its census stays
    as it is, with all that is in it; where none are given, those of the class are meant.
    """
    if having is None:
        having = ANYTHING if kind is Node else bits_of(kind)
    return _rewritten(kind, change, having, node)


def _rewritten(kind: type[Node], change: Callable[[Any], Node], having: int, node: Node) -> Any:
    if having != ANYTHING and not census_of(node) & having:
        return node
    fields, is_wanted = _plan(type(node), kind)
    if fields:
        node = _with_changed(node, fields, partial(_rewritten, kind, change, having))
    return change(node) if is_wanted else node


def map_children(node: AnyNode, change: Callable[[Node], Node]) -> AnyNode:
    """Return the node with each node directly inside it changed; `change` has to descend itself."""
    return _with_changed(node, node_fields(type(node)), change)


def replace_node(node: AnyNode, old: Wanted, new: Wanted) -> AnyNode:
    """Return the tree with one node, known by identity, replaced: equal nodes are still two."""
    return rewrite(node, type(old), lambda each: new if each is old else each)


def replace_fields(part: AnyPart, **fields: object) -> AnyPart:
    """Return the node or element with other field values; itself if it holds these objects already."""
    update = {name: new for name, new in fields.items() if not _is_same(new, getattr(part, name))}
    return part.copy(**update) if update else part


def _is_same(new: Any, old: Any) -> bool:
    """Tell whether two values are one object, or tuples of the same objects."""
    if new is old:
        return True
    return new.__class__ is tuple is old.__class__ and len(new) == len(old) and all(map(is_, new, old))


def _with_changed(node: AnyNode, fields: tuple[str, ...], change: Callable[[Node], Node]) -> AnyNode:
    update: dict[str, Node | tuple[Node, ...]] = {}
    for name in fields:
        old: Node | tuple[Node, ...] | None = getattr(node, name)
        if not old:
            continue
        if isinstance(old, tuple):
            many = tuple([change(each) for each in old])
            if not all(map(is_, many, old)):
                update[name] = many
        elif (one := change(old)) is not old:
            update[name] = one
    return node.copy(**update) if update else node


@cache
def _plan(kind: type[Node], wanted: type[Node]) -> tuple[tuple[str, ...], bool]:
    """The fields in which a node of a class may hold, at any depth, one of another class; and whether it is one."""
    # A walk for joints never looks into links.
    return tuple(name for name in node_fields(kind) if _may_hold(kind, name, wanted)), issubclass(kind, wanted)


def _may_hold(kind: type[Node], field: str, wanted: type[Node]) -> bool:
    return any(issubclass(each, wanted) for inner in classes_in(kind, field) for each in classes_below(inner))


# A bit for each of the 298 fields would make every census dear, and nobody asks for most of them.
# What is listed is derived from the facts tables and held to them by a test.
RARE: dict[type[Node], tuple[str, ...]] = {
    Axis: ("expressed_in", "mimic", "use_parent_model_frame"),
    Capsule: ("length", "radius"),
    Dynamics: ("spring_reference", "spring_stiffness"),
    Frame: ("attached_to",),
    Include: ("merge", "placement_frame"),
    Inertial: ("auto", "pose"),
    Joint: ("gearbox_ratio", "gearbox_reference_body", "screw_thread_pitch", "sensors"),
    Light: ("intensity",),
    Limit: ("acceleration", "deceleration", "dissipation", "jerk", "stiffness"),
    Link: ("enable_wind", "lights"),
    Material: ("albedo_map",),
    Model: ("canonical_link", "enable_wind", "frames", "models", "placement_frame", "self_collide"),
    Pose: ("degrees", "quat_xyzw", "relative_to", "rotation_format"),
    Sensor: ("enable_metrics", "frame_id"),
    Visual: ("plugins",),
    World: ("frames", "gravity", "joints"),
}
"""The fields that have a bit: those that not every version of their format has, and poses that are less in some.

A pose counts where it says more than six numbers.
"""

PLAIN = 1
"""Opaque parts, and the content of `<gazebo>` elements: text, and names without a namespace."""
# A file may have any number of names, so names share bits by a hash. Two that share one cost time
# and change nothing. A bit that is missing would leave a part unconverted without a word, so a test
# converts files with and without the census and asks for the same bytes.
_BUCKETS = 128
PREFIXED = (1 << _BUCKETS) - 1 << 1
"""The same with names in a namespace: many names share a bit, since there may be any number of them."""
OPAQUE = PLAIN | PREFIXED
ANYTHING = -1
_FIRST_BIT = 1 + _BUCKETS

# Where a node keeps its census. Nodes that Pydantic has made have an empty slot.
_SLOT: Any = Record.__dict__["_census"]
_get, _set = _SLOT.__get__, _SLOT.__set__


class _Plan(NamedTuple):
    """What to look at in the nodes of a class; `bits` are its own bit and those of the classes it is derived from."""

    own: int
    bits: int
    children: tuple[str, ...]
    rare: tuple[tuple[str, int], ...]


class _Plans(dict[type[Node], _Plan]):
    """The plan of each class, made when it is first needed; bits are handed out in that order."""

    def __init__(self) -> None:
        super().__init__()
        self._used = _FIRST_BIT

    def __missing__(self, kind: type[Node]) -> _Plan:
        inherited = [self[base] for base in kind.__bases__ if issubclass(base, Node) and base is not Node]
        own = RARE.get(kind, ())
        bits = [1 << (self._used + number) for number in range(len(own) + 1)]
        self._used += len(bits)
        rare = [*zip(own, bits[1:], strict=True), *(pair for plan in inherited for pair in plan.rare)]
        classes = bits[0] | union_of(plan.bits for plan in inherited)
        plan = self[kind] = _Plan(bits[0], classes, node_fields(kind), tuple(rare))
        return plan


PLANS = _Plans()


@lru_cache(maxsize=4096)
def _shared(found: int) -> int:
    """One object for equal ones: most nodes have one of few."""
    return found


def census_of(node: Node) -> int:
    """The bits of what is in a node, itself included."""
    try:
        found: int | None = _get(node)
    except AttributeError:  # Pydantic has made it
        found = None
    if found is None:
        # Nodes are frozen, so a census never goes stale; a copy starts without one.
        found = _count(node)
        _set(node, _shared(found))
    return found


def _count(node: Node) -> int:
    _, found, children, rare = PLANS[node.__class__]
    for name in children:
        value: Any = getattr(node, name)
        if not value:
            continue
        for each in value if value.__class__ is tuple else (value,):
            try:
                found |= _get(each) or census_of(each)
            except AttributeError:  # Pydantic has made it
                found |= census_of(each)
    for name, bit in rare:
        value = getattr(node, name)
        if (value or not (value is None or value == ())) and not (value.__class__ is Pose and _is_plain(value)):
            found |= bit
    if node.opaque or node.__class__ is GazeboExtension:
        found |= _count_untyped(node)
    return found


def _is_plain(pose: Pose) -> bool:
    """Whether it is six numbers, which every version can express."""
    return not (census_of(pose) & (OPAQUE | bits_of(Pose, *RARE[Pose])))


def _count_untyped(node: Node) -> int:
    if isinstance(node, GazeboExtension):
        return OPAQUE
    return union_of(map(_bit_of_part, node.opaque))


def _bit_of_part(part: Opaque) -> int:
    if part.element:
        return _bits_of_element(part.element)
    return PREFIXED if part.attribute and part.attribute[0].startswith("{") else PLAIN


def _bits_of_element(element: Element) -> int:
    """The bit of an element, and those of names in a namespace in it."""
    found = _bit_of_name(element.name) if element.name.startswith("{") else PLAIN
    for child in element.children:
        found |= _bits_of_element(child) & PREFIXED
    return found


@lru_cache(maxsize=1024)
def _bit_of_name(name: str) -> int:
    # Not `hash`, which differs from process to process.
    return 1 << 1 + crc32(name.encode()) % _BUCKETS


def bits_named(*names: str) -> int:
    """The bits of elements of these names, `{namespace}name`; a census may have them for other parts as well."""
    return union_of(map(_bit_of_name, names))


@cache
def bits_of(kind: type[Node], *fields: str) -> int:
    """The bit of the nodes of a class and of those derived from it; or those of some fields, each one of `RARE`."""
    plan = PLANS[kind]
    bits = dict(plan.rare)
    return union_of(bits[field] for field in fields) if fields else plan.own


def union_of(bits: Iterable[int]) -> int:
    """All bits of several sets of them."""
    found = 0
    for each in bits:
        found |= each
    return found


def holds_opaque(node: Node) -> bool:
    """Whether a node, or one inside it, has opaque parts or the untyped content of a `<gazebo>` element."""
    return census_of(node) & OPAQUE != 0


def untyped_elements(node: Node, *, having: int = OPAQUE) -> Iterator[Element]:
    """Every element in the opaque parts and `<gazebo>` content of a node and of all inside it, and all in these.

    Nodes without any of the bits `having` are passed over.
    """
    stack = [node]
    while stack:
        node = stack.pop()
        if not census_of(node) & having:
            continue
        own = (part.element for part in node.opaque if part.element)
        for element in (*own, *(node.content if isinstance(node, GazeboExtension) else ())):
            yield from element.walk()
        stack += reversed([*children_of(node)])


_ABOUT = frozenset({"namespaces", "format", "kind", "version"})


@cache
def node_fields(kind: type[Node]) -> tuple[str, ...]:
    """The fields of a class of nodes that may hold nodes."""
    return tuple(name for name in fields_of(kind) if classes_in(kind, name))


@cache
def classes_in(kind: type[Node], field: str) -> frozenset[type[Node]]:
    """The classes of the nodes that a field may hold."""
    return frozenset(_classes(fields_of(kind)[field].type, kind))


def _classes(annotation: Any, own: type[Node]) -> Iterator[type[Node]]:
    if annotation is Self:
        yield own
    elif not isinstance(annotation, type):
        for each in get_args(annotation):
            yield from _classes(each, own)
    elif issubclass(annotation, Node):
        yield annotation


@cache
def classes_below(kind: type[Node]) -> frozenset[type[Node]]:
    """Return a class of nodes with the classes of all nodes that may be inside it, at any depth."""
    found = {kind}
    queue = [kind]
    for each in queue:  # grows while it is walked
        fresh = {one for name in node_fields(each) for one in classes_in(each, name)} - found
        found |= fresh
        queue.extend(fresh)
    return frozenset(found)


def node_values(node: Node) -> Iterator[tuple[str, Node | tuple[Node, ...]]]:
    """Yield the fields of a node that hold nodes, each with its one or several nodes."""
    for name in node_fields(type(node)):
        value = getattr(node, name)
        if value:
            yield name, value


def children_of(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of its fields."""
    for name in node_fields(type(node)):
        value = getattr(node, name)
        if isinstance(value, tuple):
            yield from value
        elif value:
            yield value


def walk(node: Node) -> Iterator[Node]:
    """A node and all nodes inside it, from the outside in."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        if inside := [*children_of(current)]:
            inside.reverse()
            stack += inside


def count_parts(node: Node) -> int:
    """How many facts a node states: one for each node, written value, and opaque element or attribute."""
    return sum(1 + _count_values(one) for one in walk(node))


def _count_values(node: Node) -> int:
    return sum(_weight(value) for name, value in field_values(node).items() if name not in _ABOUT)


def _weight(value: object) -> int:
    if value is None or isinstance(value, Node):
        return 0
    if not isinstance(value, tuple):
        return 1
    parts: tuple[object, ...] = value  # pyright: ignore[reportUnknownVariableType]
    if not parts or isinstance(parts[0], Node):
        return 0
    if isinstance(parts[0], Element | Opaque):
        return sum(part.weight for part in parts if isinstance(part, Element | Opaque))
    return 1
