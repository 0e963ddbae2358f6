"""Facts about what urdf-usd-converter writes: the tree of links in its stage, misplaced elements, and attributes."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import field

from twinform.dataclass import dataclass
from twinform.profiles.forms import number_in
from twinform.profiles.nodes import Fact, FactTable, RawNode

_PLACES: Mapping[str, frozenset[str]] = {
    **dict.fromkeys(("box", "cylinder", "mesh", "sphere"), frozenset({"geometry"})),
    **dict.fromkeys(("inertia", "mass"), frozenset({"inertial"})),
    **dict.fromkeys(("color", "texture"), frozenset({"material"})),
    **dict.fromkeys(("collision", "inertial", "visual"), frozenset({"link"})),
    **dict.fromkeys(("axis", "calibration", "child", "dynamics", "limit", "mimic"), frozenset({"joint"})),
    **dict.fromkeys(("parent", "safety_controller"), frozenset({"joint"})),
    **dict.fromkeys(("joint", "link"), frozenset({"robot"})),
    **dict.fromkeys(("actuator", "hardwareInterface", "horizontal", "robot", "type", "vertical"), frozenset[str]()),
    "geometry": frozenset({"visual", "collision"}),
    "material": frozenset({"robot", "visual"}),
    "mechanicalReduction": frozenset(),
    "origin": frozenset({"inertial", "visual", "collision", "joint"}),
    "verbose": frozenset({"collision"}),
}
"""The elements that the converter knows, and the elements in which they may stand."""
_SHAPES = ("box", "sphere", "cylinder", "mesh")
_DIAGONAL = ("ixx", "iyy", "izz")
_MOMENTS = (*_DIAGONAL, "ixy", "ixz", "iyz")


def _last_child(node: RawNode, tag: str) -> RawNode | None:
    """The last child with a tag, which is the one that the converter takes."""
    found: RawNode | None = None
    for found in node.all(tag):  # noqa: B007  the last one is what is wanted
        pass
    return found


def _joint_end(joint: RawNode, tag: str) -> str:
    end = _last_child(joint, tag)
    return "" if end is None else end.attributes.get("link", "")


@dataclass(slots=True, eq=False)
class _Stage:
    """The links that are reached from the root, the number of joints to each, and these joints."""

    links: dict[str, RawNode]
    below: dict[str, list[RawNode]]
    led: frozenset[str]
    """The children of joints that other joints mimic."""
    times: dict[str, int] = field(default_factory=dict[str, int])
    joints: list[RawNode] = field(default_factory=list[RawNode])
    merged: set[str] = field(default_factory=set[str])
    """Links that become a part of their parent; whatever is below them is dropped."""
    loop: RawNode | None = None

    def walk(self, root: str) -> None:
        """Walk from a link to all links below; stops at a link that is below itself."""
        self.times[root] = 1
        above: set[str] = {root}
        stack = [(root, self._joints_below(root))]
        while stack and self.loop is None:
            name, joints = stack[-1]
            joint = next(joints, None)
            if joint is None:
                above.discard(name)
                stack.pop()
                continue
            child = _joint_end(joint, "child")
            self.joints.append(joint)
            self.times[child] = self.times.get(child, 0) + 1
            if child in above:
                self.loop = joint
            elif self.times[child] == 1:
                above.add(child)
                stack.append((child, self._joints_below(child)))

    def _joints_below(self, name: str) -> Iterator[RawNode]:
        """The joints below a link, without the one whose child becomes a part of the link."""
        merged = self._merged_joint(name)
        if merged is not None:
            self.merged.add(_joint_end(merged, "child"))
        return iter([j for j in self.below.get(name, ()) if j is not merged and _joint_end(j, "child") in self.links])

    def _merged_joint(self, name: str) -> RawNode | None:
        """The fixed joint whose child only gives this link its inertial, and is no link of the stage."""
        link = self.links[name]
        if _has_mass(link) or not _has_shapes(link):
            return None
        for joint in self.below.get(name, ()):
            child = self.links.get(_joint_end(joint, "child"))
            if child is None or joint.type != "fixed" or child.name in self.led:
                continue
            if _has_mass(child) and not _has_shapes(child):
                return joint
        return None


def _has_shapes(link: RawNode) -> bool:
    return link.first("visual") is not None or link.first("collision") is not None


def _has_mass(link: RawNode) -> bool:
    """Whether a link has a mass, or without one some moment."""
    inertial = _last_child(link, "inertial")
    mass = None if inertial is None else _last_child(inertial, "mass")
    if inertial is None or mass is None:
        return False
    inertia = _last_child(inertial, "inertia")
    if (number_in(mass.attributes.get("value", "0")) or 0.0) > 0:
        return True
    return inertia is not None and any(number_in(inertia.attributes.get(each, "0")) for each in _DIAGONAL)


def _build_stage(root: RawNode) -> _Stage | None:
    """The stage of a robot; None if no root carries another link."""
    links = {link.name: link for link in root.all("link")}
    joints = list(root.all("joint"))
    below: dict[str, list[RawNode]] = {}
    for joint in joints:
        below.setdefault(_joint_end(joint, "parent"), []).append(joint)
    children = {_joint_end(joint, "child") for joint in joints}
    leaders = {mimic.attributes.get("joint") for joint in joints if (mimic := _last_child(joint, "mimic")) is not None}
    led = (_joint_end(joint, "child") for joint in joints if joint.name in leaders)
    first = next((name for name in below if name not in children), None) if joints else next(iter(links), None)
    if first is None or first not in links:
        return None
    stage = _Stage(links, below, frozenset(led))
    stage.walk(first)
    return stage


def _rootless_stages(root: RawNode) -> Fact:
    """A robot without a root that carries another link, or the joint that closes a loop below the root."""
    stage = _build_stage(root)
    if stage is None and root.first("link") is not None:
        yield root, "no link that has another one below it is a root"
    elif stage is not None and stage.loop is not None:
        yield stage.loop, f"joint {stage.loop.name!r} closes a loop"


def _unreached_links(root: RawNode) -> Fact:
    """Links that are not below the root at which the converter begins, or are there several times."""
    stage = _build_stage(root)
    if stage is None or stage.loop is not None:
        return
    for name, link in stage.links.items():
        times = stage.times.get(name, 0)
        if times > 1:
            yield link, f"link {name!r} has several joints above it"
        elif not times and name not in stage.merged:
            yield link, f"link {name!r} is not below the root that it begins with, or below one that is left out"


def _misplaced_elements(root: RawNode) -> Fact:
    """Known elements inside of known elements where they may not stand."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        for child in node.children:
            if _is_at_home(child, node):
                waiting.append(child)
            elif child.tag in _PLACES:
                yield child, f"<{node.tag}> has a <{child.tag}>"


def _is_at_home(child: RawNode, node: RawNode) -> bool:
    return node.tag in _PLACES.get(child.tag, ())


def _strange_attributes(root: RawNode) -> Fact:
    """Unknown attributes that are copied to the stage although their names are invalid in USD."""
    stage = _build_stage(root)
    if stage is None:
        return
    reached = [link for name, link in stage.links.items() if name in stage.times]
    shapes = [shape for link in reached for shape in link.children if _is_shape(shape)]
    moving = [joint for joint in stage.joints if joint.type != "floating"]
    for node in (root, *root.all("material"), *reached, *shapes, *moving):
        for each in (node, *_unknown_below(node)):
            name = next((name for name in each.attributes if not _is_writable(name)), None)
            if name is not None:
                yield each, f"<{each.tag.rpartition('}')[2]}> has an attribute {name!r}"


def _is_shape(node: RawNode) -> bool:
    geometry = _last_child(node, "geometry") if node.tag in {"visual", "collision"} else None
    return geometry is not None and any(child.tag in _SHAPES for child in geometry.children)


def _unknown_below(node: RawNode) -> Iterator[RawNode]:
    """The children that the converter does not know, and all elements in them."""
    waiting = [child for child in node.children if not _is_at_home(child, node)]
    while waiting:
        each = waiting.pop()
        waiting += each.children
        yield each


def _is_writable(name: str) -> bool:
    return all(piece.isidentifier() for piece in name.split(":"))


def _strange_opacities(root: RawNode) -> Fact:
    """Colors with an opacity that is not from 0 to 1, of the first material of each name."""
    met = {material.name for material in root.all("material")}
    visuals = root.all("link", "visual")
    inside = [material for visual in visuals if (material := _last_child(visual, "material")) is not None]
    for material in (*root.all("material"), *inside):
        is_inside, name = material in inside, material.name
        if is_inside and name and name in met:
            continue
        met.add(name)
        color = _last_child(material, "color")
        numbers = [number_in(piece) for piece in (color.attributes.get("rgba", "") if color else "").split()]
        if color is not None and len(numbers) == len("rgba") and not _is_opacity(numbers[-1]):
            yield color, f"the opacity of a color is {numbers[-1]:g}"


def _is_opacity(number: float | None) -> bool:
    return number is None or math.isnan(number) or 0 <= number <= 1


def _endless_moments(root: RawNode) -> Fact:
    """Infinite moments in an inertial with an origin, which the converter rotates."""
    for inertial in (each for link in root.all("link") if (each := _last_child(link, "inertial")) is not None):
        inertia = _last_child(inertial, "inertia")
        if inertia is None or inertial.first("origin") is None:
            continue
        for name in _MOMENTS:
            number = number_in(inertia.attributes.get(name, "0"))
            if number is not None and not math.isfinite(number):
                yield inertia, f"{name!r} of <inertia> is {inertia.attributes[name]!r}"


FACTS: FactTable = {
    "rootless-stage": _rootless_stages,
    "unreached-link": _unreached_links,
    "misplaced-element": _misplaced_elements,
    "strange-attribute": _strange_attributes,
    "strange-opacity": _strange_opacities,
    "endless-moment": _endless_moments,
}
