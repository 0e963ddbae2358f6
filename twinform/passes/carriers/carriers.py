"""Carriers: pieces of one format that travel inside a file of the other, where every reader but ours skips them.

A carrier is an element of our namespace, named after the format that its piece belongs to, inside the element that the
piece belongs to:

    <tf:urdf at="limit"><foo/></tf:urdf>                  an element, inside the piece's own `limit`
    <tf:urdf attribute="k" value="1"/>                    an attribute; an empty one without `value`
    <tf:urdf attribute="k" blanks="20 9"/>                one of blanks, by their code points
    <tf:urdf text="free"/>                                text

libsdformat strips attributes, and prints an error for an empty one of an element that it does not know, so a piece has
none:

    <material><tf:empty attribute="name"/></material>                  <material name=""/>
    <material><tf:empty attribute="name" blanks="20"/></material>      <material name=" "/>
"""

import re
from collections.abc import Callable, Iterable
from functools import cache, partial
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, Rule
from twinform.ir import (
    OPAQUE,
    Document,
    Element,
    Format,
    GazeboExtension,
    Model,
    Node,
    Opaque,
    bits_named,
    replace_fields,
    rewrite,
    untyped_elements,
)
from twinform.schemas import XmlElement, node_xml, read_element

# Elements in a namespace are what none of thirteen readers refuses and none reads otherwise
# (tests/oracles/test_readers.py asks them). urdf_parser_py, and Drake in SDF, report that they skip them.
NAMESPACE = "urn:twinform:1"
PREFIX = "tf"
_OURS = f"{{{NAMESPACE}}}"
KEPT = f"{_OURS}mjcf"
"""The element in which a node keeps what only MJCF says of it."""
ROOT = "mujoco"
"""The section by which a model or world says that it was read of MJCF: `<tf:mjcf><mujoco/></tf:mjcf>`."""

Attributes = tuple[tuple[str, str], ...]

_EMPTY = f"{_OURS}empty"
SOURCE = "source"
"""What early versions of twinform wrote at the end of a model: changes that lead back to the source."""

DANGLING: Attributes = (("dangling", "true"),)
"""The attribute of a carrier about a piece that named what was not there, so that this is no sign of an edit."""

OVERRULED: Attributes = (("overruled", "true"),)
"""The attribute of a carrier about a tag behind which another one of the same field stood."""
SECOND: Attributes = (("index", "1"),)
"""The attribute of a carrier about a piece that stood beside another one of its kind, and is no rest of that."""

AnyNode = TypeVar("AnyNode", bound=Node)


@dataclass(frozen=True, slots=True)
class Keeper:
    """Enters parts that the target cannot express into the ledger: as carried, or as dropped without `carriers`."""

    sink: DiagnosticSink
    carriers: bool

    def account(self, rule: Rule, message: str, where: Location, weight: int = 1) -> None:
        """Enter one part, of so many elements and attributes."""
        self.sink.account(Fate.CARRIED if self.carriers else Fate.DROPPED, rule, message, where, weight)


def carry(node: AnyNode, pieces: Iterable[Opaque], dialect: str, about: Attributes = ()) -> AnyNode:
    """The node with these pieces of the other format in carriers; `about` are more attributes of the carriers."""
    carriers = pack(pieces, dialect, about)
    return node.copy(opaque=(*node.opaque, *carriers)) if carriers else node


def pack(pieces: Iterable[Opaque], dialect: str, about: Attributes = ()) -> tuple[Opaque, ...]:
    """A carrier for each of the pieces, with these attributes besides."""
    return tuple([Opaque.unchecked(element=_make_carrier(piece, dialect, about)) for piece in pieces])


@cache
def bits_of_ours(*kinds: str) -> int:
    """The bits of the census for carriers and annotations of these kinds."""
    return bits_named(*(f"{_OURS}{kind}" for kind in kinds))


def declare_carriers(document: Document) -> Document:
    """The document with the prefix of carriers declared if it is SDF."""
    pair = (PREFIX, NAMESPACE)
    if document.format is Format.URDF or pair in document.namespaces:
        return document
    return document.copy(namespaces=(*document.namespaces, pair))


def is_carrier(part: Opaque, dialect: str) -> bool:
    """Whether an opaque part is a carrier of a piece of this format."""
    return part.element is not None and part.element.name == f"{{{NAMESPACE}}}{dialect}"


def is_dangling(part: Opaque) -> bool:
    """Whether what a carrier holds named a part that was not there."""
    return part.element is not None and part.element.get("dangling") is not None


def is_overruled(part: Opaque) -> bool:
    """Whether a carrier holds a tag behind which another one of the same field stood."""
    return part.element is not None and part.element.get("overruled") is not None


def is_ours(part: Opaque) -> bool:
    """Whether an opaque part is of our own namespace: a carrier, or an annotation."""
    name = part.element.name if part.element else part.attribute[0] if part.attribute else ""
    return name.startswith(_OURS)


def is_memory(part: Opaque) -> bool:
    """Whether only early versions of twinform wrote such a part, which remembered the source.

    That is `<tf:source>`, attributes of our namespace, and carriers of what stood outside the model (`at="/sdf"`).
    """
    if part.element is None:
        return is_ours(part)
    return is_carrier(part, SOURCE) or (is_ours(part) and (part.element.get("at") or "").startswith("/"))


def has_ours(node: Node) -> bool:
    """Whether a carrier or annotation is anywhere in a node."""
    return any(element.name.startswith(_OURS) for element in untyped_elements(node))


def unpack(part: Opaque) -> tuple[Opaque, ...]:
    """The pieces in a carrier: the inverse of what `carry` packs."""
    element = part.element
    if element is None:
        return ()
    at = element.get("at") or ""
    name, value, text = element.get("attribute"), element.get("value"), element.get("text")
    if name is not None:
        return (Opaque.unchecked(at=at, attribute=(name, _blank_value(element) if value is None else value)),)
    if text is not None:
        return (Opaque.unchecked(at=at, text=text),)
    return tuple(Opaque.unchecked(at=at, element=_with_empty(child)) for child in element.children)


def to_element(node: Node, tag: str, dialect: str) -> Element:
    """A typed node as the element that it is in a format."""
    return from_xml(node_xml(dialect, node, tag))


def from_xml(xml: XmlElement) -> Element:
    """An XML tree as an `Element`."""
    return read_element(xml, "", None)


def _make_carrier(piece: Opaque, dialect: str, about: Attributes) -> Element:
    attributes = [*about, ("at", piece.at)] if piece.at else [*about]
    if piece.attribute is not None:
        name, value = piece.attribute
        attributes += [("attribute", name), *(_blanks(value) if _is_blank(value) else [("value", value)])]
    if piece.text is not None:
        attributes.append(("text", piece.text))
    children = (_without_empty(piece.element),) if piece.element is not None else ()
    return Element.unchecked(name=f"{{{NAMESPACE}}}{dialect}", attributes=tuple(attributes), children=children)


def _is_blank(value: str) -> bool:
    """Whether a reader that strips values sees none."""
    return not value.strip()


def _blanks(value: str) -> Attributes:
    """An attribute for the characters of a blank value; none for an empty one."""
    return (("blanks", " ".join(f"{ord(character):x}" for character in value)),) if value else ()


def _blank_value(element: Element) -> str:
    """The inverse of `_blanks`; what somebody wrote there that is no blank of XML counts for nothing."""
    codes = (element.get("blanks") or "").split()
    characters = (chr(int(code, 16)) for code in codes if re.fullmatch("[0-9a-f]{1,4}", code))
    return "".join(each for each in characters if each.isspace() and (each >= " " or each in "\t\n\r"))


def _without_empty(element: Element) -> Element:
    """The element with its attributes without a value, and those of all below, as elements."""
    if not any(_is_blank(value) for each in element.walk() for _, value in each.attributes):
        return element
    empty = [pair for pair in element.attributes if _is_blank(pair[1])]
    annotations = [
        Element.unchecked(name=_EMPTY, attributes=(("attribute", name), *_blanks(value))) for name, value in empty
    ]
    attributes = tuple(pair for pair in element.attributes if pair not in empty)
    children = (*annotations, *map(_without_empty, element.children))
    return element.copy(attributes=attributes, children=children)


def _with_empty(element: Element) -> Element:
    """The inverse of `_without_empty`; an attribute that is there by now stays."""
    if not any(each.name == _EMPTY for each in element.walk()):
        return element
    empty = [(child.get("attribute"), _blank_value(child)) for child in element.find_all(_EMPTY)]
    added = tuple((name, value) for name, value in empty if name and element.get(name) is None)
    children = tuple(_with_empty(child) for child in element.children if child.name != _EMPTY)
    return element.copy(attributes=(*element.attributes, *added), children=children)


Unwanted = Callable[[Opaque], bool]
_BODIES = frozenset({"frame", "joint", "link", "model"})
"""What `<gazebo>` adds to a robot: readers of URDF other than Gazebo's do not look into it."""


def without_ours(node: AnyNode) -> AnyNode:
    """The node without carriers and annotations: what every other reader sees."""
    return without_parts(node, is_ours)


def without_bodies_for_gazebo(node: AnyNode) -> AnyNode:
    """The node without the links, joints and frames that only Gazebo adds to a robot of URDF."""
    return rewrite(node, Model, _without_bodies)


def _without_bodies(model: Model) -> Model:
    extensions = ((each, _without_bodies_in(each)) for each in model.extensions)
    kept = tuple(left for each, left in extensions if left.content or not each.content)
    return replace_fields(model, extensions=kept)


def _without_bodies_in(extension: GazeboExtension) -> GazeboExtension:
    if extension.reference is not None:
        return extension
    return replace_fields(extension, content=tuple(one for one in extension.content if one.name not in _BODIES))


def without_parts(node: AnyNode, unwanted: Unwanted) -> AnyNode:
    """The node without some untyped parts, also in the untyped parts of all below."""
    return rewrite(node, Node, partial(_without_parts, unwanted), having=OPAQUE)


def _without_parts(unwanted: Unwanted, node: Node) -> Node:
    bare = partial(_bare_element, unwanted)
    kept = (part for part in node.opaque if not unwanted(part))
    opaque = tuple(replace_fields(part, element=bare(part.element)) if part.element else part for part in kept)
    if isinstance(node, GazeboExtension):
        return replace_fields(node, opaque=opaque, content=_bare_elements(unwanted, node.content))
    return replace_fields(node, opaque=opaque)


def _bare_element(unwanted: Unwanted, element: Element) -> Element:
    return replace_fields(element, children=_bare_elements(unwanted, element.children))


def _bare_elements(unwanted: Unwanted, elements: tuple[Element, ...]) -> tuple[Element, ...]:
    kept = (each for each in elements if not unwanted(Opaque.unchecked(element=each)))
    return tuple(_bare_element(unwanted, each) for each in kept)
