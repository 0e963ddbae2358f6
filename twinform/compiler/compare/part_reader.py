"""Reads nodes of the IR as parts: every value in them with its type, its line in the file and its default."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from functools import cache

from lxml import etree

from twinform.compiler.compare.compared_robot import Leaf, Leaves, LinkPart
from twinform.compiler.compare.compared_values import Text
from twinform.compiler.compare.leaves import (
    CARRIED,
    CARRIER_OF_URDF,
    LeafWalk,
    Resolve,
    definition,
    numbered,
    unpack_sdf,
    urdf_pieces,
    urdf_row,
)
from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.ir import Document, Element, Format, Frame, Joint, Link, Model, Node, Sensor, World, node_fields
from twinform.ir.sensor import RENAMED_ELEMENTS
from twinform.ir.transform import Transform
from twinform.ir.visual import Collision, Visual
from twinform.passes.carriers.absorb import definition_of
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.carriers.old_names import NAME
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
"""The fields of a node that hold parts, with the names of their elements in SDF."""
_APART: Mapping[type[Node], tuple[str, ...]] = {
    Model: ("links", "joints", "frames", "models", "includes"),
    World: ("models", "joints", "frames", "includes"),
    Document: ("worlds", "models", "includes"),
}
"""The fields of a node whose content is compared separately."""
_ALWAYS_TYPED = frozenset({"visual", "collision"})
"""Elements that always have a typed form in the IR, unless they come out of a carrier."""
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
"""Paths that are compared in another form than they are written in, such as poses in the model's frame."""
Places = Callable[[str], Source | None]
"""A function from the path of a value to the place where it was read."""
_NOTHING = Element.unchecked(name="nothing")
_NOT_OF_THE_ROBOT = frozenset({"material", "link", "name", "type"})
"""Contents of URDF carriers that only tell how the file is written, or that the model also has in SDF syntax."""
_IN_URDF: Mapping[type[Node], tuple[str, ...]] = {
    Model: (),
    Link: ("link",),
    Joint: ("joint",),
    Visual: ("link", "visual"),
    Collision: ("link", "collision"),
}
"""The path of a node's element in URDF's facts table."""
_IDLE = "gazebo"
"""Carriers keep those tags of `<gazebo>` that set nothing."""
_NEW_NAMES = {**RENAMED_ELEMENTS, "gpu_ray": "gpu_lidar"}
"""Old names of sensor types and of elements with their parameters; readers know both the old and the new names."""
_IGNORED_LIMITS = frozenset({"limit/@lower", "limit/@upper"})
"""Carried limits are those of continuous joints, which are ignored; those of other joints are in SDF syntax."""


@dataclass(frozen=True, slots=True)
class PartReader:
    """Reads the nodes of one model; `resolve` places poses, and `format` is the format of the file."""

    resolve: Resolve
    format: Format = Format.SDF

    @property
    def _not_of_the_robot(self) -> frozenset[str]:
        """Carried contents that are ignored; tags of `<gazebo>` without effect count only in a URDF file."""
        return _NOT_OF_THE_ROBOT if self.format is Format.URDF else _NOT_OF_THE_ROBOT | {_IDLE}

    def parts(
        self, node: Link | Joint | Model | World | Document, frame: Transform
    ) -> tuple[Leaves, tuple[LinkPart, ...]]:
        """Return the values of a node itself, and the parts in it; poses are relative to its frame."""
        fields = _PARTS[type(node)]
        tag = definition_of(node) or ""
        parts = [self.part(child, fields[name], frame) for name in fields for child in getattr(node, name)]
        apart = (*fields, *_APART.get(type(node), ()))
        xml = _sdf_xml(node.copy(**dict.fromkeys(apart, ())), tag)
        leaves, inner = self._read_own(xml, tag, _places(node), frame, skipped=_RESOLVED[type(node)])
        expressed, carried = self._read_urdf_carriers(xml, node)
        return {**leaves, **expressed}, (*parts, *inner, *carried)

    def element(self, xml: XmlElement, tag: str, where: Source | None, frame: Transform) -> LinkPart:
        """Read an element without a typed form as a part."""
        unpack_sdf(xml, definition(tag))
        skipped = _RESOLVED[Model] if tag == "model" else frozenset[str]()
        leaves = self._leaves(xml, tag, lambda _: where, frame, skipped)
        return LinkPart(tag, _part_name(xml), leaves, where, carried=xml.get(CARRIED) is not None)

    def part(self, node: Node, tag: str, frame: Transform) -> LinkPart:
        """Read a node as a part; a pose in it that names no frame is relative to `frame`."""
        xml, places = _sdf_xml(node, tag), _places(node)
        unpack_sdf(xml, definition(tag))
        leaves = self._leaves(xml, tag, places, frame)
        expressed, _ = self._read_urdf_carriers(xml, node)
        return LinkPart(tag, _part_name(xml), {**leaves, **expressed}, places(""))

    def _leaves(
        self, xml: XmlElement, tag: str, places: Places, frame: Transform, skipped: frozenset[str] = frozenset()
    ) -> dict[str, Leaf]:
        """Return the values of an element, without its name."""
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

    def _read_own(
        self, xml: XmlElement, tag: str, places: Places, frame: Transform, *, skipped: frozenset[str]
    ) -> tuple[Leaves, list[LinkPart]]:
        """Return the values of an element itself, and its repeatable children as parts."""
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

    def _read_urdf_carriers(self, xml: XmlElement, node: Node) -> tuple[dict[str, Leaf], list[LinkPart]]:
        """Return the contents of URDF carriers in an element: values, and parts of the model."""
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
                continue  # readers that take the first and those that take the last read the same
            if name is not None:
                path = f"{at}/@{name}" if at else f"@{name}"
                if name not in _NOT_OF_THE_ROBOT and path not in _IGNORED_LIMITS:
                    leaves |= self._free_leaves(_text_element(piece.get("value") or ""), path, node.source)
            elif tag == CARRIER_OF_URDF or not self._says_something(at, piece, node, known):
                continue  # text between elements, which no reader looks at, or something without effect
            elif isinstance(node, Model) and not tag.startswith("{"):  # either format may hold other namespaces
                found = self._free_leaves(piece, "", node.source, row)
                found.pop("@name", None)
                name = piece.get("name") or piece.get("reference") or ""
                parts.append(LinkPart(tag, name, found, node.source, only=Format.URDF))
            else:
                leaves |= self._free_leaves(piece, numbered(tag, seen), node.source, row)
        floating = find_annotation(node, FLOATING) if isinstance(node, Link) else None
        if floating is not None and floating.get("joint") and floating.get("parent"):  # else it makes no joint
            leaves["joint"] = Leaf(Text(floating.get("joint") or ""), None, node.source)
        return {path: replace(leaf, only=Format.URDF, carried=False) for path, leaf in leaves.items()}, parts

    def _says_something(self, at: str, piece: XmlElement, node: Node, known: Collection[str | None]) -> bool:
        """Whether an element in a URDF carrier says something about the robot; `known` are names of joints."""
        if str(piece.tag) in self._not_of_the_robot or (isinstance(node, Joint) and _is_idle(at, piece, node)):
            return False
        return not (_is_about_nothing(piece, known) if isinstance(node, Model) else piece.tag in _typed_in_urdf())


@cache
def _child_rows(tag: str) -> Mapping[str, Fact]:
    """Return the rows of an element's child elements by name."""
    return {row.name: row for row in definition(tag).children}


def _row_of_urdf(node: Node, at: str, tag: str) -> Fact | None:
    """Return the row of a URDF element at a path in the element of a node."""
    way = _IN_URDF.get(type(node))
    robot = table("urdf").definitions["robot"]
    return urdf_row(robot, *way, *filter(None, at.split("/")), tag) if way is not None else None


@cache
def _typed_in_urdf() -> frozenset[str]:
    """Return the names of elements with typed forms: a carrier only holds second ones, which readers of URDF skip."""
    definitions = (table("urdf").definitions[name] for name in ("link", "joint"))
    return frozenset(row.name for each in definitions for row in _all_below(each) if row.place and row.dialect is None)


def _all_below(fact: Fact) -> Iterator[Fact]:
    for row in fact.children:
        inner = table("urdf").resolve(row)
        yield row
        yield from _all_below(inner)


def _is_about_nothing(piece: XmlElement, known: Collection[str | None]) -> bool:
    """Whether an element names a joint that is not `known`: the element does not go back to URDF either."""
    carrier = piece.getparent()
    if carrier is not None and carrier.get("dangling"):
        return False
    return any(name not in known for name in joints_of(from_xml(piece)))


def _names_of_joints(model: Model) -> Collection[str | None]:
    """Return the present and former names of a model's joints, and of the frames and links that stand for joints."""
    names: set[str | None] = {name for joint in model.joints for name in (joint.name, _old_name(joint))}
    names |= {name for frame in model.frames for name in (frame.name, _old_name(frame))}
    return names | {(find_annotation(link, FLOATING) or _NOTHING).get("joint") for link in model.links}


def _old_name(node: Joint | Frame) -> str | None:
    return (find_annotation(node, NAME) or _NOTHING).text


def _is_idle(at: str, piece: XmlElement, joint: Joint) -> bool:
    """Whether an element is about an axis that the joint does not have, or that has the values in SDF syntax."""
    if piece.tag not in OF_AN_AXIS:
        return False
    return joint.axis is None or joint.type == "fixed" or (not at and joint.type not in WITHOUT_AXIS)


def _places(node: Node) -> Places:
    """Return a function from a path in a node to where it was read: the source of the nearest node around it."""
    known = {path: inner.source for path, inner in _single_nodes(node, "") if inner.source is not None}

    def where(path: str) -> Source | None:
        while path and path not in known:
            path = path.rpartition("/")[0]
        return known.get(path)

    return where


def _single_nodes(node: Node, path: str) -> Iterator[tuple[str, Node]]:
    """Yield a node and the single nodes in it, with the paths of their elements."""
    yield path, node
    for name in node_fields(type(node)):
        child = getattr(node, name)
        if isinstance(child, Node):
            step = getattr(child, "kind", name)
            yield from _single_nodes(child, f"{path}/{step}" if path else step)


def _text_element(text: str) -> XmlElement:
    made = etree.Element("value")
    made.text = text
    return made


def _part_name(xml: XmlElement) -> str:
    """Return the name of a part; a plugin without a name is named after its file, as a conversion names it."""
    name = xml.get("name") or ""
    return plugin_stem(xml.get("filename")) if xml.tag == "plugin" and not name else name


def _sdf_xml(node: Node, tag: str) -> XmlElement:
    made = node_xml("sdf", node, tag)
    if isinstance(node, Sensor):
        _use_new_names(made)
        _name_collisions_once(made)
    return made


def _name_collisions_once(sensor: XmlElement) -> None:
    """Remove repetitions of the collisions whose contacts a sensor tells of."""
    known = set[str]()
    for contact in sensor.iterchildren("contact"):
        for collision in [*contact.iterchildren("collision")]:
            name = (collision.text or "").strip()
            if name in known:
                contact.remove(collision)
            known.add(name)


def _use_new_names(sensor: XmlElement) -> None:
    """Replace old names of the type of a sensor and of its elements, such as `ray`, by new ones, such as `lidar`."""
    kind = sensor.get("type")
    if kind in _NEW_NAMES:
        sensor.set("type", _NEW_NAMES[kind])
    written = {str(child.tag) for child in sensor}
    for child in sensor:
        word = _NEW_NAMES.get(child.tag) if isinstance(child.tag, str) else None
        if word is not None and word not in written:
            child.tag = word
