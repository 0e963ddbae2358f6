"""Facts about joints that follow others, limits, and the transmissions that Drake reads."""

from collections.abc import Callable, Iterator, Mapping

from twinform.profiles.reading.bodies import Fact
from twinform.profiles.reading.nodes import Node

_SINGLE = frozenset({"revolute", "continuous", "prismatic"})
"""The types with one degree of freedom."""


def _joints(root: Node) -> dict[str, Node]:
    return {joint.attributes.get("name", ""): joint for joint in root.all("joint")}


def _kind(joint: Node | None) -> str:
    return "" if joint is None else joint.attributes.get("type", "")


def _mimics(root: Node) -> Iterator[tuple[Node, Node, str]]:
    """Each joint that follows another, its `<mimic>`, and the name of the other."""
    for joint in root.all("joint"):
        if (mimic := joint.first("mimic")) is not None:
            yield joint, mimic, mimic.attributes.get("joint", "")


def _follows_itself(root: Node) -> Fact:
    for joint, mimic, leader in _mimics(root):
        if leader == joint.attributes.get("name", "") and _kind(joint) != "fixed":
            yield mimic, f"joint {leader!r} follows itself"


def _follows_nothing(root: Node) -> Fact:
    known = _joints(root)
    for _, mimic, leader in _mimics(root):
        if leader not in known:
            yield mimic, f"{leader!r} is no joint that can be followed"


def _unlike_leader(root: Node) -> Fact:
    """Joints that follow one of another number of degrees of freedom, as Drake counts them."""
    known = _joints(root)
    for joint, mimic, leader in _mimics(root):
        if _kind(joint) == "floating" or leader not in known:
            continue
        if _kind(joint) not in _SINGLE or _kind(known[leader]) not in _SINGLE:
            yield mimic, f"joint {joint.attributes.get('name', '')!r} cannot follow {leader!r}"


def _follower_of_many(root: Node) -> Fact:
    """Joints that follow, or are to follow, one that does not turn or slide along one axis."""
    known = _joints(root)
    for joint, mimic, leader in _mimics(root):
        if _kind(joint) != "fixed" and not {_kind(joint), _kind(known.get(leader))} <= _SINGLE:
            yield mimic, f"joint {joint.attributes.get('name', '')!r} cannot follow {leader!r}"


def _number(text: str | None) -> float:
    try:
        return float(text or 0)
    except ValueError:
        return 0.0


def _limited(root: Node, types: frozenset[str]) -> Iterator[tuple[Node, float | None, float | None]]:
    for joint in root.all("joint"):
        limit = joint.first("limit")
        if limit is not None and _kind(joint) in types:
            lower, upper = limit.attributes.get("lower"), limit.attributes.get("upper")
            yield limit, None if lower is None else _number(lower), None if upper is None else _number(upper)


def _swapped(root: Node) -> Fact:
    """Limits where the lower one is above the upper one; one that is not written is zero."""
    for limit, lower, upper in _limited(root, frozenset({"revolute", "prismatic"})):
        if (lower or 0.0) > (upper or 0.0):
            yield limit, f"the limits are {lower or 0.0:g} and {upper or 0.0:g}"


def _crossed(root: Node) -> Fact:
    """The same for who reads only limits that are written, of `continuous` joints, too."""
    for limit, lower, upper in _limited(root, _SINGLE):
        if lower is not None and upper is not None and lower > upper:
            yield limit, f"the limits are {lower:g} and {upper:g}"


def _equal(root: Node) -> Fact:
    for limit, lower, upper in _limited(root, frozenset({"revolute", "prismatic", "planar"})):
        if lower is not None and lower == upper:
            yield limit, f"both limits are {lower:g}"


def _bad_transmissions(root: Node) -> Fact:
    known, actuators = _joints(root), set[str]()
    for node in root.all("transmission"):
        message = _refusal(node, known, actuators)
        if message:
            yield node, message


def _refusal(node: Node, known: dict[str, Node], actuators: set[str]) -> str:
    """Why Drake refuses a transmission; empty where it does not. The names of actuators that it makes are kept."""
    kind = _transmission_type(node)
    if kind is None:
        return "<transmission> has no type"
    if "SimpleTransmission" not in kind:
        return ""
    actuator, name = node.value("actuator", "name"), node.value("joint", "name")
    if actuator is None or name is None:
        return f"<transmission> has no <{'joint' if actuator is not None else 'actuator'}> with a name"
    joint = known.get(name)
    if joint is None or _kind(joint) == "floating":
        return f"<transmission> is about joint {name!r}, which is not there"
    if _kind(joint) == "fixed" or _effort(joint) == 0:
        return ""
    if _effort(joint) < 0 or _kind(joint) not in _SINGLE:
        return f"<transmission> is about joint {name!r}, which nothing can drive"
    if actuator in actuators:
        return f"two actuators are called {actuator!r}"
    actuators.add(actuator)
    return ""


def _transmission_type(node: Node) -> str | None:
    written = node.first("type")
    return node.attributes.get("type") if written is None else written.text


def _effort(joint: Node) -> float:
    written = joint.value("limit", "effort")
    return float("inf") if written is None else _number(written)


def _idle_transmissions(root: Node) -> Fact:
    known = _joints(root)
    for node in root.all("transmission"):
        kind, name = _transmission_type(node), node.value("joint", "name") or ""
        joint = known.get(name)
        if kind is not None and "SimpleTransmission" not in kind:
            yield node, f"{kind.strip()!r} is no simple transmission"
        elif joint is not None and (_kind(joint) == "fixed" or _effort(joint) == 0):
            yield node, f"<transmission> is about joint {name!r}, which is fixed or has no effort"


FACTS: Mapping[str, Callable[[Node], Fact]] = {
    "follows-itself": _follows_itself,
    "follows-nothing": _follows_nothing,
    "unlike-leader": _unlike_leader,
    "follower-of-many": _follower_of_many,
    "swapped-limits": _swapped,
    "crossed-limits": _crossed,
    "equal-limits": _equal,
    "bad-transmission": _bad_transmissions,
    "idle-transmission": _idle_transmissions,
}
"""Facts by their names in tables."""
