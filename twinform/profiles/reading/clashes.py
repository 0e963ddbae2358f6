"""Facts about names of one kind that mean something else to a consumer: links, joints, shapes, materials."""

from collections.abc import Callable, Iterator, Mapping

from twinform.profiles.reading.bodies import Fact
from twinform.profiles.reading.nodes import Node


def _name(node: Node) -> str:
    return node.attributes.get("name", "")


def _is_reserved(name: str) -> bool:
    return name == "world" or (len(name) >= 4 and name.startswith("__") and name.endswith("__"))


def _kept_links(root: Node) -> Iterator[Node]:
    """Links that libsdformat does not lump into others, nor takes for the world."""
    joints = {joint.value("child", "link") or "": joint for joint in root.all("joint")}
    for link in root.all("link"):
        joint = joints.get(_name(link))
        if joint is None:
            if _name(link) != "world":
                yield link
        elif joint.attributes.get("type") != "fixed" or joint.value("parent", "link") == "world":
            yield link


def _reserved(root: Node) -> Fact:
    """Names that SDF keeps for itself."""
    moving = (joint for joint in root.all("joint") if joint.attributes.get("type") != "fixed")
    for node in (root, *_kept_links(root), *moving):
        if _is_reserved(_name(node)):
            yield node, f"<{node.tag}> has the name {_name(node)!r}"


def _shared(root: Node) -> Fact:
    """Joints with the name of a link."""
    links = set(map(_name, _kept_links(root)))
    for joint in root.all("joint"):
        if joint.attributes.get("type") != "fixed" and _name(joint) in links:
            yield joint, f"joint {_name(joint)!r} has the name of a link"


def _repeated_shapes(tag: str, *, anywhere: bool) -> Callable[[Node], Fact]:
    def fact(root: Node) -> Fact:
        met = set[str]()
        for link in root.all("link"):
            if not anywhere:
                met.clear()
            for shape in link.all(tag):
                if _name(shape) and _name(shape) in met:
                    yield shape, f"two of the <{tag}> elements are called {_name(shape)!r}"
                met.add(_name(shape))

    return fact


def _several_nameless_shapes(root: Node) -> Fact:
    for link in root.all("link"):
        for shape in (*link.all("visual"), *link.all("collision")):
            if shape.attributes.get("name") == "":
                yield shape, f"a <{shape.tag}> of link {_name(link)!r} has an empty name"


def _redefined_materials(root: Node) -> Fact:
    """Materials that get another color or texture than they have."""
    looks = dict[str, tuple[str | None, str | None]]()
    visuals = [visual for link in root.all("link") for visual in link.all("visual")]
    for node in (*root.all("material"), *(each for visual in visuals for each in visual.all("material"))):
        look = (_spaced(node.value("color", "rgba")), node.value("texture", "filename"))
        if not _name(node) or look == (None, None):
            continue
        if looks.setdefault(_name(node), look) != look:
            yield node, f"material {_name(node)!r} is defined otherwise before"


def _spaced(text: str | None) -> str | None:
    """Numbers as they are compared: `1.0` is `1`."""
    if text is None:
        return None
    try:
        return " ".join(f"{float(each):g}" for each in text.split())
    except ValueError:
        return text


def _with_prefixes(root: Node) -> Fact:
    """Elements that have an attribute of a namespace."""
    nodes = [root]
    for node in nodes:  # grows while it is walked
        nodes.extend(node.children)
        strange = next((name for name in node.attributes if name.startswith("{")), None)
        if strange is not None:
            yield node, f"<{node.tag.rpartition('}')[2]}> has an attribute {strange!r}"


def _weighing_world(root: Node) -> Fact:
    for link in root.all("link"):
        if _name(link) == "world" and link.first("inertial") is not None:
            yield link, "link 'world' has an <inertial>"


FACTS: Mapping[str, Callable[[Node], Fact]] = {
    "reserved-name": _reserved,
    "shared-name": _shared,
    "repeated-visual": _repeated_shapes("visual", anywhere=False),
    "repeated-collision": _repeated_shapes("collision", anywhere=False),
    "repeated-collision-anywhere": _repeated_shapes("collision", anywhere=True),
    "nameless-shape": _several_nameless_shapes,
    "redefined-material": _redefined_materials,
    "weighing-world": _weighing_world,
    "prefixed-attribute": _with_prefixes,
}
"""Facts by their names in tables."""
