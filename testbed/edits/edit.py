"""An edit of a robot file as data: operations on its XML tree, as a person makes them in a text editor.

An edit names what it changes by the paths of elements (`/robot/link[2]/inertial/mass`), so that it can be printed,
kept in a file and made again: `Edit.from_text(str(edit)) == edit`.
"""

import json
import re
from collections.abc import Iterable
from dataclasses import astuple, dataclass
from typing import Any, cast

from lxml import etree

from twinform.passes.carriers.carriers import NAMESPACE, PREFIX
from twinform.schemas import XmlElement

NAMING = frozenset(
    {"name", "link", "joint", "reference", "parent", "child", "relative_to", "attached_to", "canonical_link"}
    | {"expressed_in", "placement_frame", "frame"}
    | {"body", "body1", "body2", "joint1", "joint2", "site", "geom", "geom1", "geom2", "objname", "material", "target"}
)
"""Attributes whose value is the name of a part of a robot."""
_NOT_NAMING = frozenset({"type", "filename", "uri", "format"})
"""Elements whose text is a keyword, even where a part has the same name."""


class EditError(LookupError):
    """An edit does not fit the file: it has no such element."""


@dataclass(frozen=True, slots=True)
class SetText:
    """Give an element another text."""

    at: str
    text: str

    def apply(self, found: XmlElement) -> None:
        """Change the element."""
        found.text = self.text


@dataclass(frozen=True, slots=True)
class SetAttribute:
    """Give an attribute of an element another value, or take it away: None."""

    at: str
    name: str
    value: str | None

    def apply(self, found: XmlElement) -> None:
        """Change the element."""
        if self.value is None:
            found.attrib.pop(self.name, None)
        else:
            found.set(self.name, self.value)


@dataclass(frozen=True, slots=True)
class Delete:
    """Delete an element with all that is in it."""

    at: str

    def apply(self, found: XmlElement) -> None:
        """Change the element's parent."""
        parent = found.getparent()
        if parent is not None:
            parent.remove(found)


@dataclass(frozen=True, slots=True)
class Insert:
    """Put a piece of XML, an element or a comment, into an element as its child of this number."""

    at: str
    position: int
    xml: str

    def apply(self, found: XmlElement) -> None:
        """Change the element."""
        wrapped = etree.fromstring(f'<r xmlns:{PREFIX}="{NAMESPACE}">{self.xml}</r>')
        found.insert(self.position, wrapped[0])


@dataclass(frozen=True, slots=True)
class Move:
    """Put an element elsewhere: into the element `to`, as its child of this number."""

    at: str
    to: str
    position: int

    def apply(self, found: XmlElement) -> None:
        """Change both parents."""
        target = find(found.getroottree().getroot(), self.to)
        target.insert(self.position, found)


@dataclass(frozen=True, slots=True)
class Rename:
    """Replace a name wherever it stands as a name: search and replace. `carriers` is whether in ours too."""

    at: str
    old: str
    new: str
    carriers: bool

    def apply(self, found: XmlElement) -> None:
        """Change all elements below this one."""
        for element in found.iter(etree.Element):
            if is_text_of_ours(element):
                self._rename_in_text(element)
            elif self.carriers or not is_ours(element):
                self._rename(element)

    def _rename_in_text(self, element: XmlElement) -> None:
        if self.carriers:
            name, data = (element.get(each) or "" for each in ("name", "data"))
            element.set("name", re.sub(rf":{re.escape(self.old)}$", lambda _: f":{self.new}", name))
            whole = re.compile(rf"(?<=[\">]){re.escape(self.old)}(?=[\"<])")
            element.set("data", whole.sub(lambda _: self.new, data))

    def _rename(self, element: XmlElement) -> None:
        for name, value in element.items():
            if name in NAMING and value == self.old:
                element.set(name, self.new)
        if not len(element) and element.tag not in _NOT_NAMING and (element.text or "").strip() == self.old:
            element.text = self.new


@dataclass(frozen=True, slots=True)
class Reindent:
    """Write a file with other white space between its elements."""

    at: str
    space: str

    def apply(self, found: XmlElement) -> None:
        """Change all elements below this one."""
        etree.indent(found, self.space)


Operation = SetText | SetAttribute | Delete | Insert | Move | Rename | Reindent
_OPERATIONS: dict[str, type[Operation]] = {
    each.__name__: each for each in (SetText, SetAttribute, Delete, Insert, Move, Rename, Reindent)
}


@dataclass(frozen=True, slots=True)
class Edit:
    """What a person does to a file in one go; `kind` is its name in reports, one of `KINDS`."""

    kind: str
    operations: tuple[Operation, ...]

    def apply(self, text: bytes) -> bytes:
        """The text of the file after the edit.

        Raises:
            EditError: it has no such element.
        """
        root = etree.fromstring(text)
        self.apply_to(root)
        return etree.tostring(root.getroottree(), xml_declaration=True, encoding="UTF-8")

    def apply_to(self, root: XmlElement) -> None:
        """Make the edit in a tree. Every path is that of the tree before the edit.

        Raises:
            EditError: it has no such element.
        """
        found = [find(root, each.at) for each in self.operations]
        for operation, element in zip(self.operations, found, strict=True):
            operation.apply(element)

    def __str__(self) -> str:
        words = [self.kind, *([type(each).__name__, *astuple(each)] for each in self.operations)]
        return json.dumps(words, ensure_ascii=False)

    @staticmethod
    def from_text(text: str) -> "Edit":
        """The edit that prints so.

        Raises:
            ValueError: it is not the text of an edit.
        """
        kind, *operations = cast("list[Any]", json.loads(text))
        try:
            made = tuple(_OPERATIONS[name](*fields) for name, *fields in operations)
        except (KeyError, TypeError) as error:
            raise ValueError(f"not the text of an edit: {text}") from error
        return Edit(kind, made)


def apply_all(edits: Iterable[Edit], text: bytes) -> bytes:
    """The text of a file after some edits, one after the other.

    Raises:
        EditError: it has no such element.
    """
    for edit in edits:
        text = edit.apply(text)
    return text


def path_of(element: XmlElement) -> str:
    """The path of an element, by which an edit finds it."""
    return element.getroottree().getpath(element)


def find(root: XmlElement, path: str) -> XmlElement:
    """The element at a path.

    Raises:
        EditError: there is none.
    """
    elements = root.iter(etree.Element) if ":" in path else ()
    prefixes = {name: uri for each in elements for name, uri in each.nsmap.items() if name}
    found = cast("list[XmlElement]", root.getroottree().xpath(path, namespaces={**prefixes, PREFIX: NAMESPACE}))
    if not found:
        raise EditError(f"there is no {path}")
    return found[0]


def is_ours(element: XmlElement) -> bool:
    """Whether an element is a carrier: in our namespace, inside an element that is, or a text of MJCF."""
    inner: XmlElement | None = element
    while inner is not None:
        if str(inner.tag).startswith(f"{{{NAMESPACE}}}") or is_text_of_ours(inner):
            return True
        inner = inner.getparent()
    return False


def is_text_of_ours(element: XmlElement) -> bool:
    """Whether an element is a carrier of MJCF: a `<text name="twinform:..." data="..."/>`."""
    # MuJoCo puts the prefix of an attached model before the name
    return element.tag == "text" and "twinform:" in (element.get("name") or "")
