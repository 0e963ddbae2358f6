"""Facts about the links, joints and materials of a robot as a whole: names, references, and the shape of the tree."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping

from twinform.ir.groups import Groups
from twinform.profiles.reading import body_facts, clashes, colors, drives, extensions, lumped_masses, stage
from twinform.profiles.reading.forms import FORMS
from twinform.profiles.reading.nodes import RawNode

Fact = Iterator[tuple[RawNode, str]]
"""Elements that it is about, and what is so."""
_ONE_WAY = frozenset({"revolute", "continuous", "prismatic"})
_SIZES = {
    name: FORMS[form][1]
    for name, form in (
        ("xyz", "python3"),
        ("rpy", "python3"),
        ("size", "python3"),
        ("radius", "python"),
        ("length", "python"),
    )
}
_KNOWN = _ONE_WAY | {"planar", "floating", "fixed"}


def _names(nodes: Iterator[RawNode]) -> list[str]:
    return [node.attributes.get("name", "") for node in nodes]


def _ends(joint: RawNode) -> tuple[str, str]:
    return joint.value("parent", "link") or "", joint.value("child", "link") or ""


def _repeated(tag: str) -> Callable[[RawNode], Fact]:
    return lambda root: _of_one_name(root.all(tag), f"<{tag}> elements")


def _of_one_name(nodes: Iterable[RawNode], what: str) -> Fact:
    """Those of the elements that have the name of one before them."""
    met = set[str]()
    for node in nodes:
        name = node.attributes.get("name", "")
        if name in met:
            yield node, f"two of the {what} are called {name!r}"
        met.add(name)


def _repeated_links_but_world(root: RawNode) -> Fact:
    return (found for found in _repeated("link")(root) if found[0].attributes.get("name") != "world")


def _linkless(root: RawNode) -> Fact:
    if root.first("link") is None:
        yield root, "there is no <link>"


def _open_joints(root: RawNode) -> Fact:
    for joint in root.all("joint"):
        if not all(_ends(joint)):
            yield joint, f"joint {joint.attributes.get('name', '')!r} has no parent or no child"


def _of_nowhere(end: int) -> Callable[[RawNode], Fact]:
    def fact(root: RawNode) -> Fact:
        links = set(_names(root.all("link")))
        for joint in root.all("joint"):
            if (name := _ends(joint)[end]) not in links:
                kind = ("parent", "child")[end]
                yield (
                    joint,
                    f"joint {joint.attributes.get('name', '')!r} has the {kind} {name!r}, but there is no such link",
                )

    return fact


def _of_nowhere_but_world(end: int) -> Callable[[RawNode], Fact]:
    """Joints that have all their names, and one of a link that is not there and not the world."""
    unknown = _of_nowhere(end)

    def fact(root: RawNode) -> Fact:
        for joint, message in unknown(root):
            names = (joint.attributes.get("name"), joint.attributes.get("type"), *_ends(joint))
            if all(names) and _ends(joint)[end] != "world":
                yield joint, message

    return fact


def _foreign_custom_ends(root: RawNode) -> Fact:
    """Frames and joints of Drake's own at a link that is not there and not the world."""
    links = {*_names(root.all("link")), "world"}
    for joint in root.all("drake:joint"):
        for name in filter(None, _ends(joint)):
            if name not in links:
                yield joint, f"joint {joint.attributes.get('name', '')!r} is at {name!r}, but there is no such link"
    for frame in root.all("frame"):
        if frame.attributes.get("link", "world") not in links:
            who, link = frame.attributes.get("name", ""), frame.attributes["link"]
            yield frame, f"frame {who!r} is at {link!r}, but there is no such link"


def _loops(root: RawNode) -> Fact:
    """Joints between links that are joined already, whichever of them is above."""
    groups = Groups()
    for joint in (*root.all("joint"), *root.all("drake:joint")):
        parent, child = _ends(joint)
        if joint.attributes.get("type") == "floating" or not joint.attributes.get("name") or not parent or not child:
            continue
        if parent != child and not groups.join(parent, child):
            yield joint, f"joint {joint.attributes['name']!r} joins {parent!r} and {child!r}, which are joined already"


def _self_joints(root: RawNode) -> Fact:
    for joint in root.all("joint"):
        parent, child = _ends(joint)
        if parent == child != "":
            yield joint, f"joint {joint.attributes.get('name', '')!r} joins {parent!r} to itself"


def _repeated_moving_joints(root: RawNode) -> Fact:
    moving = (joint for joint in root.all("joint") if joint.attributes.get("type") != "fixed")
    return _of_one_name(moving, "joints that move")


def _repeated_shapes(root: RawNode) -> Fact:
    for link in root.all("link"):
        for tag in ("visual", "collision"):
            # a shape without a name takes the empty one, and is no mistake itself
            found = _of_one_name(link.all(tag), f"<{tag}> elements of a link")
            yield from (each for each in found if "name" in each[0].attributes)


def _repeated_collisions(root: RawNode) -> Fact:
    shapes = (shape for link in root.all("link") for shape in link.all("collision"))
    return _of_one_name((shape for shape in shapes if shape.attributes.get("name")), "<collision> elements")


def _held_by_roots(root: RawNode, joints: list[RawNode]) -> set[str]:
    """Roots, and what is fixed to them."""
    fixed: dict[str, list[str]] = {}
    for joint in joints:
        if joint.attributes.get("type") == "fixed":
            parent, child = _ends(joint)
            fixed.setdefault(parent, []).append(child)
    held, waiting = set[str](), ["world", *_names(iter(_roots(root)))]
    while waiting:
        name = waiting.pop()
        if name not in held:
            held.add(name)
            waiting += fixed.get(name, ())
    return held


def _shared_names(root: RawNode) -> Fact:
    links = set(_names(root.all("link")))
    for joint in root.all("joint"):
        if (name := joint.attributes.get("name", "")) in links and joint.attributes.get("type") != "fixed":
            yield joint, f"a joint and a link are called {name!r}"


def _free_below(root: RawNode) -> Fact:
    joints = list(root.all("joint"))
    held = _held_by_roots(root, joints)
    for joint in joints:
        if joint.attributes.get("type") == "floating" and _ends(joint)[0] not in held:
            yield joint, f"joint {joint.attributes.get('name', '')!r} is floating below a link"


def _unknown_leaders(root: RawNode) -> Fact:
    names = set(_names(root.all("joint")))
    for joint in root.all("joint"):
        mimic = joint.first("mimic")
        leader = None if mimic is None else mimic.attributes.get("joint")
        if mimic is not None and leader and leader not in names:
            yield mimic, f"the joint {leader!r} to follow is not there"


def _stiff_mimics(root: RawNode) -> Fact:
    """Joints that follow themselves, or one that is not there or has not one degree of freedom, or have not one."""
    moving = set(_names(joint for joint in root.all("joint") if joint.attributes.get("type") in _ONE_WAY))
    for joint in root.all("joint"):
        mimic, name = joint.first("mimic"), joint.attributes.get("name", "")
        if mimic is None:
            continue
        leader = mimic.attributes.get("joint", "")
        if leader not in moving or leader == name or joint.attributes.get("type") not in _ONE_WAY:
            yield mimic, f"joint {name!r} follows {leader!r}, and one of them does not move, or is not another one"


def _unread_numbers(root: RawNode) -> Fact:
    """Numbers of places and sizes, whatever element has them."""
    nodes = [root]
    while nodes:
        node = nodes.pop()
        nodes += node.children
        for name, reads in _SIZES.items():
            if name in node.attributes and not reads(node.attributes[name]):
                yield node, f"{name!r} of <{node.tag}> is {node.attributes[name]!r}"


def _roots(root: RawNode) -> list[RawNode]:
    children = {_ends(joint)[1] for joint in root.all("joint")}
    return [link for link in root.all("link") if link.attributes.get("name", "") not in children]


def _several_roots(root: RawNode) -> Fact:
    found = _roots(root)
    if len(found) > 1:
        names = ", ".join(repr(link.attributes.get("name", "")) for link in found[:4])
        yield found[1], f"{len(found)} links have no joint above them: {names}"


def _no_root(root: RawNode) -> Fact:
    if root.first("link") is not None and not _roots(root):
        yield root, "every link has a joint above it: there is no root"


def _two_parents(root: RawNode) -> Fact:
    counts = Counter[str]()
    for joint in root.all("joint"):
        child = _ends(joint)[1]
        counts[child] += 1
        if counts[child] > 1:
            yield joint, f"two joints have the child {child!r}"


def _circular_links(root: RawNode) -> Fact:
    """Links in a circle that no root leads to."""
    above = {child: parent for parent, child in map(_ends, root.all("joint"))}
    circular = dict[str, bool]()
    for joint in root.all("joint"):
        way, name = dict[str, None](), _ends(joint)[1]
        # What an earlier joint decided is not walked again, so the whole stays linear.
        while name in above and name not in way and name not in circular:
            way[name] = None
            name = above[name]
        circular |= dict.fromkeys(way, name in way or circular.get(name, False))
        if circular.get(_ends(joint)[1], False):
            yield joint, f"joint {joint.attributes.get('name', '')!r} is in a circle, or below one"


def _weightless(root: RawNode) -> Fact:
    for link in root.all("link"):
        if link.first("inertial") is None and link.attributes.get("name") != "world":
            yield link, f"link {link.attributes.get('name', '')!r} has no <inertial>"


def _idle_leaders(root: RawNode) -> Fact:
    """Joints that follow one that does not move by itself."""
    joints = list(root.all("joint"))
    moving = set(_names(j for j in joints if j.first("mimic") is None and j.attributes.get("type") != "fixed"))
    for joint in joints:
        if (mimic := joint.first("mimic")) is not None and mimic.attributes.get("joint", "") not in moving:
            yield mimic, f"{mimic.attributes.get('joint', '')!r} is no joint that moves by itself"


def _foreign_joints(root: RawNode) -> Fact:
    """Joints of an unknown kind before one that turns or slides."""
    foreign: RawNode | None = None
    for joint in root.all("joint"):
        kind = joint.attributes.get("type")
        if joint.first("mimic") is None and kind not in _KNOWN:
            foreign = foreign or joint
        elif foreign is not None and joint.first("mimic") is None and kind in _ONE_WAY:
            yield (
                foreign,
                f"joint {foreign.attributes.get('name', '')!r} is of the type {foreign.attributes.get('type')!r}",
            )
            return


FACTS: Mapping[str, Callable[[RawNode], Fact]] = {
    "repeated-link": _repeated("link"),
    "repeated-link-but-world": _repeated_links_but_world,
    "foreign-custom-end": _foreign_custom_ends,
    "loop": _loops,
    "repeated-joint": _repeated("joint"),
    "repeated-material": _repeated("material"),
    "repeated-moving-joint": _repeated_moving_joints,
    "repeated-shape": _repeated_shapes,
    "repeated-collision": _repeated_collisions,
    "self-joint": _self_joints,
    "free-below": _free_below,
    "unknown-leader": _unknown_leaders,
    "stiff-mimic": _stiff_mimics,
    "unknown-parent-but-world": _of_nowhere_but_world(0),
    "unknown-child-but-world": _of_nowhere_but_world(1),
    "unread-numbers": _unread_numbers,
    "no-links": _linkless,
    "open-joint": _open_joints,
    "unknown-parent": _of_nowhere(0),
    "unknown-child": _of_nowhere(1),
    "indefinite-inertia": body_facts.indefinite,
    "unbalanced-inertia": body_facts.unbalanced,
    "uncertain-inertia": body_facts.uncertain,
    "unphysical-inertia": body_facts.unphysical,
    "shared-name": _shared_names,
    "weightless-body": body_facts.weightless,
    "reversed-limits": drives.reversed_limits,
    "equal-limits": drives.equal_limits,
    "self-mimic": drives.self_mimics,
    "idle-mimic": drives.idle_mimics,
    "unknown-number": drives.unknown_numbers,
    "foreign-transmission": drives.foreign_transmissions,
    "repeated-actuator": drives.repeated_actuators,
    "idle-transmission": drives.idle_transmissions,
    "several-roots": _several_roots,
    "no-root": _no_root,
    "two-parents": _two_parents,
    "circle": _circular_links,
    "weightless-link": _weightless,
    "foreign-joint": _foreign_joints,
    **clashes.FACTS,
    **colors.FACTS,
    **lumped_masses.FACTS,
    **extensions.FACTS,
    **stage.FACTS,
    "idle-leader": _idle_leaders,
}
"""By the names that a table calls them."""
