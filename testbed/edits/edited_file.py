"""An edited file as readers see it that do not know our carriers, and what its annotations mean."""

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Literal, NamedTuple

from lxml import etree

from testbed.edits.edit import is_text_of_ours
from twinform.passes.carriers.annotations import may_write_scopes
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.schemas import XmlElement

OURS = f"{{{NAMESPACE}}}"
Language = Literal["urdf", "sdf", "mjcf"]
_LANGUAGES: Mapping[object, Language] = {"robot": "urdf", "sdf": "sdf", "mujoco": "mjcf"}

_SITE = "site "


class Geom(NamedTuple):
    """What tells a geom of MJCF from others: its body, its name, which may be made, and its shape."""

    body: str
    name: str
    shape: str


class EditedFile:
    """A file after its edits. Its trees are parsed when they are first asked for, and are not to be changed."""

    def __init__(self, text: bytes) -> None:
        self.text = text

    @cached_property
    def root(self) -> XmlElement:
        """The tree as it stands in the file."""
        return etree.fromstring(self.text)

    @property
    def language(self) -> Language:
        """The language that it is written in."""
        return _LANGUAGES[self.root.tag]

    @cached_property
    def named(self) -> XmlElement:
        """The tree with the names that annotations give."""
        root = etree.fromstring(self.text)
        _give_names_back(root)
        return root

    @cached_property
    def plain(self) -> XmlElement:
        """The tree without anything in our namespace, under the names that annotations give."""
        root = etree.fromstring(self.text)
        _give_names_back(root)
        for element in list(root.iter(etree.Element)):
            if str(element.tag).startswith(OURS) or is_text_of_ours(element):
                _take_out(element)
            for name in [str(key) for key in element.keys() if str(key).startswith(OURS)]:  # noqa: SIM118 - an element
                del element.attrib[name]
        etree.cleanup_namespaces(root)
        return root

    @cached_property
    def _texts(self) -> tuple[XmlElement, ...]:
        """What texts of MJCF hold."""
        texts = (each.get("data") or "" for each in self.root.iter("text") if is_text_of_ours(each))
        return tuple(map(etree.fromstring, texts))

    @cached_property
    def sites_of_sensors(self) -> frozenset[str]:
        """The sites of MJCF that stand for sensors: they are called after these and the models that they are in."""
        parts = (line.strip() for text in self._texts for each in text.iter(f"{OURS}parts") for line in _lines(each))
        return frozenset(each.removeprefix(_SITE) for each in parts if each.startswith(_SITE))

    @cached_property
    def carried_shapes(self) -> frozenset[Geom]:
        """The visuals and collisions that only texts of MJCF have, since it has none like them."""
        links = (link for text in self._texts for link in text.iter("link"))
        found = ((link, each) for link in links for each in link.iterchildren("visual", "collision"))
        carried = {
            Geom(_name(link), _name(each), shape)
            for link, each in found
            if each.find(f"{OURS}rest") is None
            for shape in _shapes_in(each)
        }
        return frozenset(carried - set(map(geom_in, self.root.iter("geom"))))

    @cached_property
    def holders(self) -> dict[str, XmlElement]:
        """The joints of URDF by the link that they hold."""
        return {end(joint, "child"): joint for joint in self.root.iterfind("joint")}

    @cached_property
    def rigid(self) -> dict[str, str]:
        """The link that each link is fixed to, if to any; a joint that closes a circle is left out."""
        held: dict[str, str] = {}
        for joint in self.root.iter("joint"):
            child = end(joint, "child")
            if joint.get("type") == "fixed" and child not in held and not _leads_to(child, end(joint, "parent"), held):
                held[child] = end(joint, "parent")
        return held

    def are_fixed(self, one: str, other: str) -> bool:
        """Whether fixed joints hold two links to each other."""
        return _top(one, self.rigid) == _top(other, self.rigid)

    @cached_property
    def parts(self) -> frozenset[str]:
        """The names of the links and joints that are in a chain."""
        parts = {
            str(part.get("name"))
            for annotation in self.root.iter(f"{OURS}part")
            if (part := annotation.getparent()) is not None
        }
        return frozenset(parts | {str(last.get("name")) for last in self.annotated("joint", "chain")})

    def annotated(self, tag: str, annotation: str) -> list[XmlElement]:
        """The elements with an annotation."""
        return [each for each in self.root.iter(tag) if each.find(f"{OURS}{annotation}") is not None]


def without_scenery(file: EditedFile) -> EditedFile:
    """A file of MJCF without the shapes that belong to no body."""
    root = etree.fromstring(file.text)
    for geom in [*root.iterfind("worldbody/geom")]:
        _take_out(geom)
    return EditedFile(etree.tostring(root))


def geom_in(geom: XmlElement) -> Geom:
    """A geom of MJCF."""
    around = geom.getparent()
    return Geom("" if around is None else _name(around), _name(geom), geom.get("type", "sphere"))


def scoped_name(holder: XmlElement | None) -> str:
    """What a link or joint of URDF is called in SDF."""
    if holder is None:
        return ""
    name = holder.get("name") or ""
    annotation = holder.find(f"{OURS}scoped-name")
    return (annotation.text or name) if annotation is not None and annotation.get("instead_of") == name else name


def end(joint: XmlElement, tag: str) -> str:
    """The link at an end of a joint; empty where none is written."""
    found = joint.find(tag)
    return (found.get("link") or (found.text or "").strip()) if found is not None else ""


def _shapes_in(part: XmlElement) -> Iterator[str]:
    """Yield what the shape of a visual or collision is called in MJCF."""
    for shape in part.iterfind("geometry/*"):
        yield "hfield" if shape.tag == "heightmap" else str(shape.tag)


def _lines(element: XmlElement) -> list[str]:
    return (element.text or "").splitlines()


def _name(element: XmlElement) -> str:
    return element.get("name") or ""


def _top(name: str, held: Mapping[str, str]) -> str:
    while name in held:
        name = held[name]
    return name


def _leads_to(wanted: str, name: str, held: Mapping[str, str]) -> bool:
    """Whether a link is the other one, or fixed to it."""
    while name in held and name != wanted:
        name = held[name]
    return name == wanted


def _give_names_back(root: XmlElement) -> None:
    """Call what is annotated by its old name, everywhere: a name that had to change is no other part."""
    names: dict[str, str] = {}
    nested = {
        scoped_name(frame)
        for annotation in root.iter(f"{OURS}nested")
        if _is_frame(frame := annotation.getparent(), root)
    }
    free = any(may_write_scopes(str(annotation.get("version"))) for annotation in root.iter(f"{OURS}from"))
    for annotation in root.iter(f"{OURS}scoped-name"):
        holder = annotation.getparent()
        if holder is not None and holder.get("name") == annotation.get("instead_of") and annotation.text:
            if not free and not nested.issuperset(_scopes_in(annotation.text) or {annotation.text}):
                continue  # of what it was in nothing tells any more
            names[str(annotation.get("instead_of"))] = annotation.text
    if not names:
        return
    for element in root.iter(etree.Element):
        if (element.text or "").strip() in names:
            element.text = names[(element.text or "").strip()]
        for key, value in element.items():
            element.set(key, names.get(str(value), str(value)))


def _scopes_in(name: str) -> set[str]:
    """The models that a scoped name is in: `a` and `a::b` of `a::b::link`."""
    *scopes, _ = name.split("::")
    return {"::".join(scopes[: count + 1]) for count in range(len(scopes))}


def _is_frame(link: XmlElement | None, root: XmlElement) -> bool:
    """Whether a link that stands for the frame of a model is still nothing else: fixed to a link, without a body."""
    if link is None or link.find(f"{OURS}frame") is None or link.find("inertial/mass") is not None:
        return False
    held_by = [joint for joint in root.iterfind("joint") if end(joint, "child") == link.get("name")]
    return bool(held_by) and all(joint.get("type") == "fixed" and end(joint, "parent") != "world" for joint in held_by)


def _take_out(element: XmlElement) -> None:
    parent = element.getparent()
    if parent is not None:
        parent.remove(element)
