"""Facts about the links, joints and materials of a robot as a whole: names, references, and the shape of the tree."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping

from twinform.profiles.reading.forms import fits_bytes
from twinform.profiles.reading.nodes import Node

Fact = Iterator[tuple[Node, str]]
"""Elements that it is about, and what is so."""
_ONE_WAY = frozenset({"revolute", "continuous", "prismatic"})
_KNOWN = _ONE_WAY | {"planar", "floating", "fixed"}


def _names(nodes: Iterator[Node]) -> list[str]:
    return [node.attributes.get("name", "") for node in nodes]


def _ends(joint: Node) -> tuple[str, str]:
    return joint.value("parent", "link") or "", joint.value("child", "link") or ""


def _repeated(tag: str) -> Callable[[Node], Fact]:
    def fact(root: Node) -> Fact:
        met = set[str]()
        for node in root.all(tag):
            name = node.attributes.get("name", "")
            if name in met:
                yield node, f"two of the <{tag}> elements are called {name!r}"
            met.add(name)

    return fact


def _linkless(root: Node) -> Fact:
    if root.first("link") is None:
        yield root, "there is no <link>"


def _open_joints(root: Node) -> Fact:
    for joint in root.all("joint"):
        if not all(_ends(joint)):
            yield joint, f"joint {joint.attributes.get('name', '')!r} has no parent or no child"


def _of_nowhere(end: int) -> Callable[[Node], Fact]:
    def fact(root: Node) -> Fact:
        links = set(_names(root.all("link")))
        for joint in root.all("joint"):
            if (name := _ends(joint)[end]) not in links:
                kind = ("parent", "child")[end]
                yield joint, f"joint {joint.attributes.get('name', '')!r} has the {kind} {name!r}, which is no link"

    return fact


def _roots(root: Node) -> list[Node]:
    children = {_ends(joint)[1] for joint in root.all("joint")}
    return [link for link in root.all("link") if link.attributes.get("name", "") not in children]


def _several_roots(root: Node) -> Fact:
    found = _roots(root)
    if len(found) > 1:
        names = ", ".join(repr(link.attributes.get("name", "")) for link in found[:4])
        yield found[1], f"{len(found)} links have no joint above them: {names}"


def _no_root(root: Node) -> Fact:
    if root.first("link") is not None and not _roots(root):
        yield root, "every link has a joint above it: there is no root"


def _two_parents(root: Node) -> Fact:
    counts = Counter[str]()
    for joint in root.all("joint"):
        child = _ends(joint)[1]
        counts[child] += 1
        if counts[child] > 1:
            yield joint, f"two joints have the child {child!r}"


def _apart(root: Node) -> Fact:
    """Links in a circle that no root leads to."""
    above = {child: parent for parent, child in map(_ends, root.all("joint"))}
    for joint in root.all("joint"):
        name, met = _ends(joint)[1], set[str]()
        while name in above and name not in met:
            met.add(name)
            name = above[name]
        if name in met:
            yield joint, f"joint {joint.attributes.get('name', '')!r} is in a circle, or below one"


def _undefined_materials(root: Node) -> Fact:
    known = set(_names(root.all("material")))
    for visual in (visual for link in root.all("link") for visual in link.all("visual")):
        material = visual.first("material")
        if material is None or not (name := material.attributes.get("name", "")):
            continue
        if material.value("color", "rgba") is None and material.value("texture", "filename") is None:
            if name not in known:
                yield material, f"material {name!r} is defined nowhere before"
        else:
            known.add(name)


def _plain_materials(root: Node) -> Fact:
    for material in root.all("material"):
        if material.value("color", "rgba") is None and material.value("texture", "filename") is None:
            yield material, f"material {material.attributes.get('name', '')!r} has no color and no texture"


def _unpaintable(root: Node) -> Fact:
    """Visuals with a color, of their own or by name, that makes no bytes."""
    known = {node.attributes.get("name", ""): node for node in root.all("material")}
    for visual in (visual for link in root.all("link") for visual in link.all("visual")):
        material = visual.first("material")
        if material is not None and material.first("color") is None:
            material = known.get(material.attributes.get("name", ""))
        color = None if material is None else material.first("color")
        if color is not None and not fits_bytes(rgba := color.attributes.get("rgba", "1 1 1 1")):
            yield color, f"the color of a visual is {rgba!r}"


def _weightless(root: Node) -> Fact:
    for link in root.all("link"):
        if link.first("inertial") is None and link.attributes.get("name") != "world":
            yield link, f"link {link.attributes.get('name', '')!r} has no <inertial>"


def _idle_leaders(root: Node) -> Fact:
    """Joints that follow one that does not move by itself."""
    joints = list(root.all("joint"))
    moving = set(_names(j for j in joints if j.first("mimic") is None and j.attributes.get("type") != "fixed"))
    for joint in joints:
        if (mimic := joint.first("mimic")) is not None and mimic.attributes.get("joint", "") not in moving:
            yield mimic, f"{mimic.attributes.get('joint', '')!r} is no joint that moves by itself"


def _foreign_joints(root: Node) -> Fact:
    """Joints of an unknown kind before one that turns or slides."""
    foreign: Node | None = None
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


FACTS: Mapping[str, Callable[[Node], Fact]] = {
    "repeated-link": _repeated("link"),
    "repeated-joint": _repeated("joint"),
    "repeated-material": _repeated("material"),
    "no-links": _linkless,
    "open-joint": _open_joints,
    "unknown-parent": _of_nowhere(0),
    "unknown-child": _of_nowhere(1),
    "several-roots": _several_roots,
    "no-root": _no_root,
    "two-parents": _two_parents,
    "circle": _apart,
    "undefined-material": _undefined_materials,
    "plain-material": _plain_materials,
    "unpaintable": _unpaintable,
    "weightless-link": _weightless,
    "foreign-joint": _foreign_joints,
    "idle-leader": _idle_leaders,
}
"""By the names that a table calls them."""
