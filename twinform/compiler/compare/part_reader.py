"""Reads nodes of the IR as parts: every value in them with its kind, its line in the file and its default."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache

from lxml import etree

from twinform.compiler.compare.carried import CARRIER_OF_URDF, definition, unpack_sdf, urdf_pieces
from twinform.compiler.compare.compared_robot import Leaf, Leaves, LinkPart
from twinform.compiler.compare.compared_values import Text
from twinform.compiler.compare.leaves import CARRIED, LeafWalk, Resolve, numbered, urdf_row
from twinform.diagnostics import Source
from twinform.ir import Document, Element, Format, Frame, Joint, Link, Model, Node, Sensor, World, node_fields
from twinform.ir.sensor import RENAMED_ELEMENTS
from twinform.ir.transform import Transform
from twinform.ir.visual import Collision, Visual
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.carriers.definitions import definition_of
from twinform.passes.legalise.changed_names import NAME
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.legalise.urdf_pieces import OF_AN_AXIS, WITHOUT_AXIS, joints_of
from twinform.passes.sdf_versions.name_the_nameless import plugin_stem
from twinform.schemas import Fact, XmlElement, node_xml, table
from twinform.text import same_element

_PARTS: Mapping[type[Node], Mapping[str, str]] = {
    Link: {"visuals": "visual", "collisions": "collision", "sensors": "sensor", "lights": "light"},
    Joint: {"sensors": "sensor"},
    Model: {"plugins": "plugin"},
    World: {"plugins": "plugin", "lights": "light"},
    Document: {"lights": "light"},
}
"""Fields that hold parts of their own, and what these are called in SDF."""
_APART: Mapping[type[Node], tuple[str, ...]] = {
    Model: ("links", "joints", "frames", "models", "includes"),
    World: ("models", "joints", "frames", "includes"),
    Document: ("worlds", "models", "includes"),
}
"""What a model, world or file is made of is read by itself."""
_ALWAYS_TYPED = frozenset({"visual", "collision"})
"""What has no typed form of these came out of a carrier."""
_DIRECTION = ("xyz", "use_parent_model_frame")
_RESOLVED: Mapping[type[Node], frozenset[str]] = {
    Link: frozenset({"pose", *(f"inertial/{each}" for each in ("mass", "pose", "inertia", "@auto"))}),
    Joint: frozenset(
        {"pose", "parent", "child", "@type", *(f"{axis}/{part}" for axis in ("axis", "axis2") for part in _DIRECTION)}
    ),
    Model: frozenset(
        {"pose", "@canonical_link", "@placement_frame", "link", "joint", "frame", "model", "include", "model_state"}
    ),
    World: frozenset(),
    Document: frozenset({"@version"}),
}
"""What is compared in other terms than those in which it is written."""
Places = Callable[[str], Source | None]
"""Where what stands at a path was read."""
_NOTHING = Element(name="nothing")
_NOT_OF_THE_ROBOT = frozenset({"material", "link", "name", "type"})
"""What URDF's carriers hold that is about how the file is written, or that the model has in SDF syntax."""
_IN_URDF: Mapping[type[Node], tuple[str, ...]] = {
    Model: (),
    Link: ("link",),
    Joint: ("joint",),
    Visual: ("link", "visual"),
    Collision: ("link", "collision"),
}
"""Where URDF has the element of a node."""
_IDLE = "gazebo"
"""Of `<gazebo>`, carriers hold the tags that set nothing."""
_NEW_NAMES = {**RENAMED_ELEMENTS, "gpu_ray": "gpu_lidar"}
"""Types of sensors, and elements with their parameters, that have two names; readers take one for the other."""
_IGNORED_LIMITS = frozenset({"limit/@lower", "limit/@upper"})
"""Of a continuous joint; those of others are in SDF syntax."""


@dataclass(frozen=True, slots=True)
class PartReader:
    """How the nodes of one model are read: which frames there are, and what the format of the file is."""

    resolve: Resolve
    format: Format = Format.SDF

    @property
    def _not_of_the_robot(self) -> frozenset[str]:
        """Tags of `<gazebo>` without effect count in the file that has them, and mean nothing in a carrier."""
        return _NOT_OF_THE_ROBOT if self.format is Format.URDF else _NOT_OF_THE_ROBOT | {_IDLE}

    def parts(
        self, node: Link | Joint | Model | World | Document, frame: Transform
    ) -> tuple[Leaves, tuple[LinkPart, ...]]:
        """The values of a node itself, and the parts in it; poses are relative to its frame."""
        fields = _PARTS[type(node)]
        tag = definition_of(node) or ""
        parts = [self.part(child, fields[name], frame) for name in fields for child in getattr(node, name)]
        apart = (*fields, *_APART.get(type(node), ()))
        xml = _xml(node.copy(**dict.fromkeys(apart, ())), tag)
        leaves, inner = self._own(xml, tag, _places(node), frame, skipped=_RESOLVED[type(node)])
        expressed, carried = self._of_urdf(xml, node)
        return {**leaves, **expressed}, (*parts, *inner, *carried)

    def element(self, xml: XmlElement, tag: str, where: Source | None, frame: Transform) -> LinkPart:
        """A part that is an element without a typed form."""
        unpack_sdf(xml, definition(tag))
        skipped = _RESOLVED[Model] if tag == "model" else frozenset[str]()
        leaves = self._leaves(xml, tag, lambda _: where, frame, skipped)
        return LinkPart(tag, _name(xml), leaves, where, carried=xml.get(CARRIED) is not None)

    def part(self, node: Node, tag: str, frame: Transform) -> LinkPart:
        """A part with a typed form; a pose in it that names no frame is relative to `frame`."""
        xml, places = _xml(node, tag), _places(node)
        unpack_sdf(xml, definition(tag))
        leaves = self._leaves(xml, tag, places, frame)
        expressed, _ = self._of_urdf(xml, node)
        return LinkPart(tag, _name(xml), {**leaves, **expressed}, places(""))

    def _leaves(
        self, xml: XmlElement, tag: str, places: Places, frame: Transform, skipped: frozenset[str] = frozenset()
    ) -> dict[str, Leaf]:
        """The values of an element without its name, which is that of the part."""
        walk = LeafWalk(self.resolve, places, skipped | {"@name"})
        if definition(tag).any:
            walk.enter_free(xml, "")
            walk.found.pop("@name", None)
        else:
            walk.enter(xml, definition(tag), frame)
        return walk.found

    def _free_leaves(
        self, xml: XmlElement, path: str, where: Source | None, fact: Fact | None = None
    ) -> dict[str, Leaf]:
        walk = LeafWalk(self.resolve, lambda _: where)
        walk.enter_free(xml, path, fact=fact)
        return walk.found

    def _own(
        self, xml: XmlElement, tag: str, places: Places, frame: Transform, *, skipped: frozenset[str]
    ) -> tuple[Leaves, list[LinkPart]]:
        """The leaves of an element itself, and its named children as parts."""
        unpack_sdf(xml, definition(tag))
        rows = _child_rows(tag)
        inner: list[LinkPart] = []
        for child in [one for one in xml if isinstance(one.tag, str)]:
            row = rows.get(str(child.tag))
            if row is not None and row.repeats and row.reference and row.name not in skipped | {"frame"}:
                xml.remove(child)
                part = self.element(child, row.name, places(""), frame)
                inner.append(replace(part, carried=True) if part.kind in _ALWAYS_TYPED else part)
        return self._leaves(xml, tag, places, frame, skipped), inner

    def _of_urdf(self, xml: XmlElement, node: Node) -> tuple[dict[str, Leaf], list[LinkPart]]:
        """What only URDF has elements for, which SDF holds in carriers: leaves, and named parts of the model."""
        leaves: dict[str, Leaf] = {}
        parts: list[LinkPart] = []
        seen: dict[str, int] = {}
        pieces = [*urdf_pieces(xml)]
        known = _names_of_joints(node) if pieces and isinstance(node, Model) else frozenset[str | None]()
        firsts: dict[tuple[str, str], XmlElement] = {}
        for at, piece in pieces:
            name, tag, row = piece.get("attribute"), str(piece.tag), _row_of_urdf(node, at, str(piece.tag))
            first = firsts.setdefault((at, tag), piece)
            if first is not piece and row is not None and not row.repeats and same_element(first, piece):
                continue  # whoever takes the one or the other takes the same
            if name is not None:
                path = f"{at}/@{name}" if at else f"@{name}"
                if name not in _NOT_OF_THE_ROBOT and path not in _IGNORED_LIMITS:
                    leaves |= self._free_leaves(_text_element(piece.get("value") or ""), path, node.source)
            elif tag == CARRIER_OF_URDF or not self._counts(at, piece, node, known):
                continue  # text between elements, which no reader looks at, or what is about nothing
            elif isinstance(node, Model) and not _is_foreign(piece):
                found = self._free_leaves(piece, "", node.source, row)
                found.pop("@name", None)
                name = piece.get("name") or piece.get("reference") or ""
                parts.append(LinkPart(tag, name, found, node.source, only=Format.URDF))
            else:
                leaves |= self._free_leaves(piece, numbered(tag, seen), node.source, row)
        floating = find_annotation(node, FLOATING) if isinstance(node, Link) else None
        if floating is not None and floating.get("joint") and floating.get("parent"):  # else it makes no joint
            leaves["joint"] = Leaf(Text(floating.get("joint") or ""), None, node.source)
        return {path: _only_urdf(leaf) for path, leaf in leaves.items()}, parts

    def _counts(self, at: str, piece: XmlElement, node: Node, known: Collection[str | None]) -> bool:
        """Whether an element from a carrier of URDF says something about the robot; `known` are names of joints."""
        if str(piece.tag) in self._not_of_the_robot or (isinstance(node, Joint) and _is_idle(at, piece, node)):
            return False
        return not (_is_about_nothing(piece, known) if isinstance(node, Model) else piece.tag in _typed_in_urdf())


@cache
def _child_rows(tag: str) -> Mapping[str, Fact]:
    """The rows of the child elements of an element, by their names."""
    return {row.name: row for row in definition(tag).children}


def _row_of_urdf(node: Node, at: str, tag: str) -> Fact | None:
    """The row of an element that URDF has somewhere in what a node was read from."""
    way = _IN_URDF.get(type(node))
    robot = table("urdf").definitions["robot"]
    return urdf_row(robot, *way, *filter(None, at.split("/")), tag) if way is not None else None


@cache
def _typed_in_urdf() -> frozenset[str]:
    """Elements that fields of the IR stand for: in a carrier is the second one, and readers of URDF take the first."""
    definitions = (table("urdf").definitions[name] for name in ("link", "joint"))
    return frozenset(row.name for each in definitions for row in _below(each) if row.place and row.dialect is None)


def _below(fact: Fact) -> Iterator[Fact]:
    for row in fact.children:
        inner = table("urdf").resolve(row)
        yield row
        yield from _below(inner)


def _is_foreign(element: XmlElement) -> bool:
    """Whether it is of a namespace, which either format may hold."""
    return str(element.tag).startswith("{")


def _only_urdf(leaf: Leaf) -> Leaf:
    return Leaf(leaf.value, leaf.default, leaf.where, Format.URDF)


def _is_about_nothing(piece: XmlElement, known: Collection[str | None]) -> bool:
    """Whether it names a joint that is gone, unlike those that are `known`: then it does not go back to URDF either."""
    carrier = piece.getparent()
    if carrier is not None and carrier.get("dangling"):
        return False
    return any(name not in known for name in joints_of(from_xml(piece)))


def _names_of_joints(model: Model) -> Collection[str | None]:
    """What joints of the model, and what became of joints in it, are called or were called before."""
    names: set[str | None] = {name for joint in model.joints for name in (joint.name, _old_name(joint))}
    names |= {name for frame in model.frames for name in (frame.name, _old_name(frame))}
    return names | {(find_annotation(link, FLOATING) or _NOTHING).get("joint") for link in model.links}


def _old_name(node: Joint | Frame) -> str | None:
    return (find_annotation(node, NAME) or _NOTHING).text


def _is_idle(at: str, piece: XmlElement, joint: Joint) -> bool:
    """Whether it is about an axis that the joint does not have, or has itself."""
    if piece.tag not in OF_AN_AXIS:
        return False
    return joint.axis is None or joint.type == "fixed" or (not at and joint.type not in WITHOUT_AXIS)


def _places(node: Node) -> Places:
    """Where what stands at a path of a node was read: the nearest node around it knows."""
    known = {path: inner.source for path, inner in _inner(node, "") if inner.source is not None}

    def where(path: str) -> Source | None:
        while path and path not in known:
            path = path.rpartition("/")[0]
        return known.get(path)

    return where


def _inner(node: Node, path: str) -> Iterator[tuple[str, Node]]:
    """A node and the single nodes in it, by the paths of their elements."""
    yield path, node
    for name in node_fields(type(node)):
        child = getattr(node, name)
        if isinstance(child, Node):
            step = getattr(child, "kind", name)
            yield from _inner(child, f"{path}/{step}" if path else step)


def _text_element(text: str) -> XmlElement:
    made = etree.Element("value")
    made.text = text
    return made


def _name(xml: XmlElement) -> str:
    """What a part is called: a plugin without a name like its file, as versions of SDF call it that want one."""
    name = xml.get("name") or ""
    return plugin_stem(xml.get("filename")) if xml.tag == "plugin" and not name else name


def _xml(node: Node, tag: str) -> XmlElement:
    made = node_xml("sdf", node, tag)
    if isinstance(node, Sensor):
        _in_new_words(made)
    return made


def _in_new_words(sensor: XmlElement) -> None:
    """Rename what has an old and a new name, such as a scan of `<ray>` and of `<lidar>`, to the new one."""
    kind = sensor.get("type")
    if kind in _NEW_NAMES:
        sensor.set("type", _NEW_NAMES[kind])
    written = {str(child.tag) for child in sensor}
    for child in sensor:
        word = _NEW_NAMES.get(child.tag) if isinstance(child.tag, str) else None
        if word is not None and word not in written:
            child.tag = word
