"""Facts about the links, joints and materials of a robot as a whole: names, references, and the shape of the tree."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

from twinform.ir.groups import Groups
from twinform.profiles import colors, dynamics_facts, lumped_masses, sdformat_facts, stage
from twinform.profiles.dynamics_facts import ONE_AXIS
from twinform.profiles.forms import FORMS
from twinform.profiles.nodes import Fact, FactTable, RawNode, add_fixed, fixed_children, joint_ends

_SIZES = {
    **dict.fromkeys(("xyz", "rpy", "size"), FORMS["python3"][1]),
    **dict.fromkeys(("radius", "length"), FORMS["python"][1]),
}
"""The attributes with places and sizes, and how their numbers are read."""
_KNOWN = ONE_AXIS | {"planar", "floating", "fixed"}


def _find_repeated(tag: str) -> Callable[[RawNode], Fact]:
    """A function that finds elements with a tag whose name another one has before them."""
    return lambda root: _find_repeated_names(root.all(tag), f"<{tag}> elements")


def _find_repeated_names(nodes: Iterable[RawNode], what: str) -> Fact:
    """The elements whose name another one has before them."""
    met = set[str]()
    for node in nodes:
        name = node.name
        if name in met:
            yield node, f"two of the {what} are called {name!r}"
        met.add(name)


def _repeated_links_but_world(root: RawNode) -> Fact:
    return (found for found in _find_repeated("link")(root) if found[0].name != "world")


def _no_links(root: RawNode) -> Fact:
    if root.first("link") is None:
        yield root, "there is no <link>"


def _open_joints(root: RawNode) -> Fact:
    for joint in root.all("joint"):
        if not all(joint_ends(joint)):
            yield joint, f"joint {joint.name!r} has no parent or no child"


def _find_unknown_ends(end: int) -> Callable[[RawNode], Fact]:
    """A function that finds joints whose parent (0) or child (1) is no link."""

    def fact(root: RawNode) -> Fact:
        links = {node.name for node in root.all("link")}
        for joint in root.all("joint"):
            if (name := joint_ends(joint)[end]) not in links:
                kind = ("parent", "child")[end]
                yield (
                    joint,
                    f"joint {joint.name!r} has the {kind} {name!r}, but there is no such link",
                )

    return fact


def _find_unknown_ends_but_world(end: int) -> Callable[[RawNode], Fact]:
    """A function that finds complete joints whose parent (0) or child (1) is neither a link nor the world."""
    unknown = _find_unknown_ends(end)

    def fact(root: RawNode) -> Fact:
        for joint, message in unknown(root):
            names = (joint.name, joint.type, *joint_ends(joint))
            if all(names) and joint_ends(joint)[end] != "world":
                yield joint, message

    return fact


def _foreign_custom_ends(root: RawNode) -> Fact:
    """Drake's own joints and frames at a link that is missing and is not the world."""
    links = {*(node.name for node in root.all("link")), "world"}
    for joint in root.all("drake:joint"):
        for name in filter(None, joint_ends(joint)):
            if name not in links:
                yield joint, f"joint {joint.name!r} is at {name!r}, but there is no such link"
    for frame in root.all("frame"):
        if frame.attributes.get("link", "world") not in links:
            who, link = frame.name, frame.attributes["link"]
            yield frame, f"frame {who!r} is at {link!r}, but there is no such link"


def _loops(root: RawNode) -> Fact:
    """Joints between links that are connected already, in either direction."""
    groups = Groups()
    for joint in (*root.all("joint"), *root.all("drake:joint")):
        parent, child = joint_ends(joint)
        if joint.type == "floating" or not joint.name or not parent or not child:
            continue
        if parent != child and not groups.join(parent, child):
            yield joint, f"joint {joint.name!r} joins {parent!r} and {child!r}, which are joined already"


def _self_joints(root: RawNode) -> Fact:
    for joint in root.all("joint"):
        parent, child = joint_ends(joint)
        if parent == child != "":
            yield joint, f"joint {joint.name!r} joins {parent!r} to itself"


def _repeated_moving_joints(root: RawNode) -> Fact:
    moving = (joint for joint in root.all("joint") if joint.type != "fixed")
    return _find_repeated_names(moving, "joints that move")


def _repeated_shapes(root: RawNode) -> Fact:
    for link in root.all("link"):
        for tag in ("visual", "collision"):
            # a shape without a name takes the empty one, and is no mistake itself
            found = _find_repeated_names(link.all(tag), f"<{tag}> elements of a link")
            yield from (each for each in found if "name" in each[0].attributes)


def _repeated_collisions(root: RawNode) -> Fact:
    shapes = root.all("link", "collision")
    return _find_repeated_names((shape for shape in shapes if shape.name), "<collision> elements")


def _floating_below_links(root: RawNode) -> Fact:
    held = add_fixed(("world", *(link.name for link in _roots(root))), fixed_children(root))
    for joint in root.all("joint"):
        if joint.type == "floating" and joint_ends(joint)[0] not in held:
            yield joint, f"joint {joint.name!r} is floating below a link"


def _unknown_leaders(root: RawNode) -> Fact:
    names = {node.name for node in root.all("joint")}
    for joint in root.all("joint"):
        mimic = joint.first("mimic")
        leader = None if mimic is None else mimic.attributes.get("joint")
        if mimic is not None and leader and leader not in names:
            yield mimic, f"the joint {leader!r} to follow is not there"


def _stiff_mimics(root: RawNode) -> Fact:
    """Joints that mimic themselves or a joint that is missing, or where one of the two has no single axis."""
    moving = {joint.name for joint in root.all("joint") if joint.type in ONE_AXIS}
    for joint in root.all("joint"):
        mimic, name = joint.first("mimic"), joint.name
        if mimic is None:
            continue
        leader = mimic.attributes.get("joint", "")
        if leader not in moving or leader == name or joint.type not in ONE_AXIS:
            yield mimic, f"joint {name!r} follows {leader!r}, and one of them does not move, or is not another one"


def _unread_numbers(root: RawNode) -> Fact:
    """Places and sizes that are not numbers, in any element."""
    nodes = [root]
    while nodes:
        node = nodes.pop()
        nodes += node.children
        for name, reads in _SIZES.items():
            if name in node.attributes and not reads(node.attributes[name]):
                yield node, f"{name!r} of <{node.tag}> is {node.attributes[name]!r}"


def _roots(root: RawNode) -> list[RawNode]:
    children = {joint_ends(joint)[1] for joint in root.all("joint")}
    return [link for link in root.all("link") if link.name not in children]


def _several_roots(root: RawNode) -> Fact:
    found = _roots(root)
    if len(found) > 1:
        names = ", ".join(repr(link.name) for link in found[:4])
        yield found[1], f"{len(found)} links have no joint above them: {names}"


def _no_root(root: RawNode) -> Fact:
    if root.first("link") is not None and not _roots(root):
        yield root, "every link has a joint above it: there is no root"


def _two_parents(root: RawNode) -> Fact:
    counts = Counter[str]()
    for joint in root.all("joint"):
        child = joint_ends(joint)[1]
        counts[child] += 1
        if counts[child] > 1:
            yield joint, f"two joints have the child {child!r}"


def _circular_links(root: RawNode) -> Fact:
    """Joints in a circle, or below one: no root leads to them."""
    circular = _lead_into_circles({child: parent for parent, child in map(joint_ends, root.all("joint"))})
    for joint in root.all("joint"):
        if joint_ends(joint)[1] in circular:
            yield joint, f"joint {joint.name!r} is in a circle, or below one"


def _lead_into_circles(above: Mapping[str, str]) -> set[str]:
    """The names from which one that is above another leads into a circle."""
    known = dict[str, bool]()
    for start in above:
        way, name = dict[str, None](), start
        # What an earlier name decided is not walked again, so the whole stays linear.
        while name in above and name not in way and name not in known:
            way[name] = None
            name = above[name]
        known |= dict.fromkeys(way, name in way or known.get(name, False))
    return {name for name, circular in known.items() if circular}


def _no_root_of_joints(root: RawNode) -> Fact:
    """The first joint, where every parent of a joint is a child of another one."""
    ends = [joint_ends(joint) for joint in root.all("joint")]
    if ends and {parent for parent, _ in ends} <= {child for _, child in ends}:
        yield next(root.all("joint")), "every parent of a joint is the child of another one"


def _second_trees(root: RawNode) -> Fact:
    """Joints below a second root: a parent that no joint has as its child, after the first such one by name."""
    joints = list(root.all("joint"))
    children = {joint_ends(joint)[1] for joint in joints}
    roots = [joint for joint in joints if joint_ends(joint)[0] not in children]
    first = min((joint_ends(joint)[0] for joint in roots), default="")
    for joint in roots:
        if (parent := joint_ends(joint)[0]) != first:
            yield joint, f"link {parent!r} is a second root"


def _lone_links(root: RawNode) -> Fact:
    """Links that are at the end of no joint, where there are joints."""
    held = {end for joint in root.all("joint") for end in joint_ends(joint)}
    for link in root.all("link") if held else ():
        if link.name not in held:
            yield link, f"link {link.name!r} is at the end of no joint"


def _circular_mimics(root: RawNode) -> Fact:
    """Joints that follow themselves, directly or through others, and joints that follow those."""
    leaders = ((joint.name, joint.value("mimic", "joint")) for joint in root.all("joint"))
    circular = _lead_into_circles({name: leader for name, leader in leaders if leader})
    for joint in root.all("joint"):
        if joint.name in circular:
            yield joint, f"joint {joint.name!r} follows itself, or one that does"


def _links_without_inertial(root: RawNode) -> Fact:
    for link in root.all("link"):
        if link.first("inertial") is None and link.name != "world":
            yield link, f"link {link.name!r} has no <inertial>"


def _unlike_mimics(root: RawNode) -> Fact:
    """Joints that follow one with other degrees of freedom, or where one of the two has none of its own."""
    freedoms = {joint.name: "one" if joint.type in ONE_AXIS else joint.type for joint in root.all("joint")}
    for joint in root.all("joint"):
        leader = joint.value("mimic", "joint")
        if leader is None or leader not in freedoms:
            continue
        if freedoms[joint.name] not in {"one", "planar"} or freedoms[joint.name] != freedoms[leader]:
            yield joint, f"joint {joint.name!r} follows {leader!r}, which moves otherwise"


def _links_with_shapes_alone(root: RawNode) -> Fact:
    for link in root.all("link"):
        inertial = link.first("inertial")
        shaped = any(geometry.children for geometry in link.all("collision", "geometry"))
        if shaped and (inertial is None or inertial.first("mass") is None):
            yield link, f"link {link.name!r} has collisions and no <mass>"


def _idle_leaders(root: RawNode) -> Fact:
    """Mimics of a joint that is missing, fixed, or a mimic itself."""
    joints = list(root.all("joint"))
    moving = {j.name for j in joints if j.first("mimic") is None and j.type != "fixed"}
    for joint in joints:
        if (mimic := joint.first("mimic")) is not None and mimic.attributes.get("joint", "") not in moving:
            yield mimic, f"{mimic.attributes.get('joint', '')!r} is no joint that moves by itself"


def _foreign_joints(root: RawNode) -> Fact:
    """The first joint of an unknown type, if a joint that turns or slides follows."""
    foreign: RawNode | None = None
    for joint in root.all("joint"):
        kind = joint.type
        if joint.first("mimic") is None and kind not in _KNOWN:
            foreign = foreign or joint
        elif foreign is not None and joint.first("mimic") is None and kind in ONE_AXIS:
            yield (
                foreign,
                f"joint {foreign.name!r} is of the type {foreign.type!r}",
            )
            return


FACTS: FactTable = {
    "repeated-link": _find_repeated("link"),
    "repeated-link-but-world": _repeated_links_but_world,
    "foreign-custom-end": _foreign_custom_ends,
    "loop": _loops,
    "repeated-joint": _find_repeated("joint"),
    "repeated-material": _find_repeated("material"),
    "repeated-moving-joint": _repeated_moving_joints,
    "repeated-shape": _repeated_shapes,
    "repeated-collision": _repeated_collisions,
    "self-joint": _self_joints,
    "free-below": _floating_below_links,
    "unknown-leader": _unknown_leaders,
    "stiff-mimic": _stiff_mimics,
    "unknown-parent-but-world": _find_unknown_ends_but_world(0),
    "unknown-child-but-world": _find_unknown_ends_but_world(1),
    "unread-numbers": _unread_numbers,
    "no-links": _no_links,
    "open-joint": _open_joints,
    "unknown-parent": _find_unknown_ends(0),
    "unknown-child": _find_unknown_ends(1),
    "several-roots": _several_roots,
    "no-root": _no_root,
    "two-parents": _two_parents,
    "circle": _circular_links,
    "no-root-of-joints": _no_root_of_joints,
    "second-tree": _second_trees,
    "lone-link": _lone_links,
    "circular-mimic": _circular_mimics,
    "weightless-link": _links_without_inertial,
    "unlike-mimic": _unlike_mimics,
    "shapes-alone": _links_with_shapes_alone,
    "foreign-joint": _foreign_joints,
    **dynamics_facts.FACTS,
    **colors.FACTS,
    **lumped_masses.FACTS,
    **sdformat_facts.FACTS,
    **stage.FACTS,
    "idle-leader": _idle_leaders,
}
"""All facts, by the names that tables of reads use."""
