"""Carriers in MJCF: `<custom><text name="twinform:KIND:NAME" data="XML"/></custom>`.

The data are the element of a partial node in the newest SDF. Newlines and tabs in it are written as references, since
programs that save MJCF write them as they are, and other readers of XML take a newline in an attribute for a blank.
"""

from collections.abc import Callable, Iterable, Mapping
from hashlib import sha256
from typing import Any, NamedTuple

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Source
from twinform.ir import Document, Element, Format, Frame, Joint, Light, Link, Model, Node, World
from twinform.ir.record import maker
from twinform.passes.carriers.absorb import CarrierError
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.carriers import PREFIX as TF
from twinform.schemas import Context, XmlElement, node_xml, reader, table

PREFIX = "twinform:"
"""How the name of a text begins that is a carrier, perhaps behind the prefix that `attach` puts before names."""
DOCUMENT = "document"
"""The kind of the carrier with the format and version of the source."""
PREFIXES = "prefix"
"""The annotation in that carrier with a namespace of the source and the prefix that it had there."""
SEVERAL = "several"
"""The annotation in that carrier of models that are in no world, and on a model that has all trees of bodies."""
TREE = "tree"
"""The annotation on a model of a world with a body at the top that is in it: `<tf:tree body="base"/>`."""
SHAPE_OF = "shape"
"""The annotation on a visual or collision with the shape for which a file stands, or whose URI became a path."""
NORMAL = "normal"
"""The annotation on a visual or collision with where its plane faces, which is turned to that in MJCF."""
TERRAIN = "terrain"
"""The annotation on a visual or collision with where its terrain is in it, which MJCF has no place for but its own."""
AXES = "axes"
"""The annotation on an inertial with the orientation of its axes, which MJCF has in the axes of the body."""
ATTACHED = "attached"
"""The annotation on a frame with what it is attached to, where that is not the link that its site is in."""
FIRST = "first"
"""The annotation on a model with its first link, where another one is the first body: `<tf:first link="pole"/>`."""
LOOP = "loop"
"""The annotation on a joint that closes a loop, which is a constraint in MJCF and is kept as a whole."""
PARTS = "parts"
"""The annotation on a sensor or light with the elements that it became, and a digest by which edits are seen."""
TURN = "turn"
"""The annotation on a joint with the orientation of its frame in the link that it moves."""
LOOK_OF = "look-of"
"""The annotation on a visual with a digest of the color and material of its geom, by which edits are seen."""
PART = "part"
"""The annotation on the frame of a nested model with a part of it: `<tf:part kind="link" name="tip" as="tip_1"/>`."""
Tagged = tuple[str, Mapping[str, str]]
"""The tag and the attributes of an element."""
KINDS: Mapping[str, type[Node]] = {
    DOCUMENT: Document, "world": World, "model": Model, "link": Link, "joint": Joint, "frame": Frame, "light": Light,
}  # fmt: skip
"""The classes of nodes that have carriers of their own, by the names of their elements."""
_REFERENCES = {"\n": "&#10;", "\t": "&#9;", "\r": "&#13;"}
_PARSER = etree.XMLParser(
    resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True, remove_pis=True
)


class TextName(NamedTuple):
    """The parts of the name of a carrier: what `attach` put before it, the kind of the node and its scoped name."""

    attached: str
    kind: str
    name: str


def annotated_trees(model: Model) -> list[str]:
    """The bodies at the top that an annotated model of a world has."""
    elements = (part.element for part in model.opaque)
    return [each.get("body") or "" for each in elements if each is not None and each.name == f"{{{NAMESPACE}}}{TREE}"]


def text_name(kind: str, name: str = "") -> str:
    """The name of the carrier of a node."""
    return f"{PREFIX}{kind}:{name}" if name else f"{PREFIX}{kind}"


def parse_text_name(written: str) -> TextName | None:
    """The parts of a name; None for a text that is no carrier."""
    attached, found, rest = written.partition(PREFIX)
    if not found:
        return None
    kind, _, name = rest.partition(":")
    return TextName(attached, kind, name)


def text_element(name: str, data: str) -> Element:
    """The `<text>` of a carrier."""
    return Element.unchecked(name="text", attributes=(("name", name), ("data", data)))


def node_element(node: Node, kind: str) -> XmlElement:
    """The element of a partial node."""
    return node_xml("sdf", node, "sdf" if kind == DOCUMENT else kind, {TF: NAMESPACE})


def xml_data(xml: XmlElement) -> str:
    """A tree as the data of a carrier."""
    text = etree.tostring(xml, encoding="unicode")
    for character, reference in _REFERENCES.items():
        text = text.replace(character, reference)
    return text


def parse_data(data: str) -> XmlElement:
    """The tree in the data of a carrier.

    Raises:
        CarrierError: it is not XML, or has a document type declaration.
    """
    try:
        xml = etree.fromstring(data.encode(), _PARSER)
    except etree.XMLSyntaxError as error:
        raise CarrierError(f"it is not XML: {error.msg}") from error
    if xml.getroottree().docinfo.doctype:
        raise CarrierError("it has a DOCTYPE")
    return xml


def read_node(data: str, kind: str, source: Source) -> Node:
    """The partial node in the data of a carrier, all of which was written at one place.

    Raises:
        CarrierError: it is not XML, or not such an element of SDF.
    """
    xml = parse_data(data)
    definition = "sdf" if kind == DOCUMENT else kind
    if xml.tag != definition:
        raise CarrierError(f"it holds a <{xml.tag}>")
    for element in xml.iter():
        element.sourceline = source.line  # pyright: ignore[reportAttributeAccessIssue] - it can be set
    version, sink = table("sdf").newest, DiagnosticSink()
    context = Context(sink, source.file, "sdf", version, partial=True)
    values: dict[str, Any] = reader("sdf", version).read(xml, context, definition, KINDS[kind], source)
    if kind == DOCUMENT:
        values["format"] = Format.SDF
    return maker(KINDS[kind])(values)


def tagged(elements: Iterable[Element]) -> list[Tagged]:
    """The tags and attributes of elements."""
    return [(each.name, dict(each.attributes)) for each in elements]


def digest_of(elements: Iterable[Tagged]) -> str:
    """A digest of elements of MJCF, in any order and with numbers of five digits: MuJoCo saves six."""
    lines = sorted(
        " ".join([tag, *(f"{name}={_rounded(value)}" for name, value in sorted(attributes.items()))])
        for tag, attributes in elements
    )
    return sha256("\n".join(lines).encode()).hexdigest()[:16]


def look_parts(geom: Mapping[str, str], find: Callable[[str, str], list[Tagged]]) -> list[Tagged]:
    """The elements that say how a geom looks; `find` returns an asset with the elements in it."""
    parts: list[Tagged] = [("geom", {name: geom[name] for name in ("rgba", "material") if name in geom})]
    material = find("material", geom["material"]) if "material" in geom else []
    textures = [attributes["texture"] for _, attributes in material if "texture" in attributes]
    return [*parts, *material, *(each for name in textures for each in find("texture", name))]


def _rounded(value: str) -> str:
    try:
        return " ".join(f"{float(word):.5g}" for word in value.split())
    except ValueError:
        return value
