"""Facts about names that a consumer keeps for something else."""

from collections.abc import Callable, Iterator, Mapping

from twinform.profiles.reading.forms import number_in
from twinform.profiles.reading.lumped_masses import Fact
from twinform.profiles.reading.nodes import RawNode


def _name(node: RawNode) -> str:
    return node.attributes.get("name", "")


def _is_reserved(name: str) -> bool:
    return name == "world" or (len(name) >= 4 and name.startswith("__") and name.endswith("__"))


def _kept_links(root: RawNode) -> Iterator[RawNode]:
    """Links that libsdformat does not lump into others, nor takes for the world."""
    joints = {joint.value("child", "link") or "": joint for joint in root.all("joint")}
    for link in root.all("link"):
        joint = joints.get(_name(link))
        if joint is None:
            if _name(link) != "world":
                yield link
        elif joint.attributes.get("type") != "fixed" or joint.value("parent", "link") == "world":
            yield link


def _reserved(root: RawNode) -> Fact:
    """Names that SDF keeps for itself."""
    moving = (joint for joint in root.all("joint") if joint.attributes.get("type") != "fixed")
    for node in (root, *_kept_links(root), *moving):
        if _is_reserved(_name(node)):
            yield node, f"<{node.tag}> has the name {_name(node)!r}"


def _shared(root: RawNode) -> Fact:
    """Joints with the name of a link."""
    links = set(map(_name, _kept_links(root)))
    for joint in root.all("joint"):
        if joint.attributes.get("type") != "fixed" and _name(joint) in links:
            yield joint, f"joint {_name(joint)!r} has the name of a link"


def _placeless(root: RawNode) -> Fact:
    """Joints that libsdformat leaves out while it poses their links relative to them; a frame may have their names."""
    blocks = (block for block in root.all("gazebo") if not block.attributes.get("reference"))
    frames = {_name(frame) for block in blocks for frame in block.all("frame")}
    for joint in root.all("joint"):
        type_ = joint.attributes.get("type")
        if type_ in {"floating", "planar"} and _name(joint) not in frames:
            yield joint, f"joint {_name(joint)!r} is {type_}, and no <frame> in <gazebo> has its name"


def _weighing_world(root: RawNode) -> Fact:
    for link in root.all("link"):
        if _name(link) == "world" and link.first("inertial") is not None:
            yield link, "link 'world' has an <inertial>"


def _swapped_limits(root: RawNode) -> Fact:
    """Limits where the lower one is above the upper one; one that is not written is zero."""
    for joint in root.all("joint"):
        limit = joint.first("limit")
        if limit is not None and joint.attributes.get("type") in {"revolute", "prismatic"}:
            lower, upper = (number_in(limit.attributes.get(end, "")) or 0.0 for end in ("lower", "upper"))
            if lower > upper:
                yield limit, f"the limits of joint {_name(joint)!r} are {lower:g} and {upper:g}"


def _empty_names(root: RawNode) -> Fact:
    for link in root.all("link"):
        for shape in (*link.all("visual"), *link.all("collision")):
            if shape.attributes.get("name") == "":
                yield shape, f"a <{shape.tag}> of link {_name(link)!r} has an empty name"


def _forked_world(root: RawNode) -> Fact:
    """A link called world, at the root, that carries several others."""
    ends = [(joint.value("parent", "link"), joint.value("child", "link")) for joint in root.all("joint")]
    carried = sum(parent == "world" for parent, _ in ends)
    link = next((link for link in root.all("link") if link.attributes.get("name") == "world"), None)
    if link is not None and carried > 1 and "world" not in (child for _, child in ends):
        yield link, f"the link 'world' carries {carried} links"


FACTS: Mapping[str, Callable[[RawNode], Fact]] = {
    "reserved-name": _reserved,
    "swapped-limits": _swapped_limits,
    "empty-name": _empty_names,
    "shared-name": _shared,
    "weighing-world": _weighing_world,
    "forked-world": _forked_world,
    "placeless-link": _placeless,
}
"""Facts by their names in tables."""
