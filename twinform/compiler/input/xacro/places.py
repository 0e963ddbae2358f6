"""Source locations in `minidom` trees: elements that know their file and line."""

from collections.abc import Iterator
from typing import Any
from xml.dom import expatbuilder, minidom
from xml.parsers.expat import ExpatError

_MOST_TAGS = 1_000_000
_KEY = "source"

FileLine = tuple[str, int]


class BadFileError(Exception):
    """A file that cannot be expanded whatever is in its macros; `is_syntax` says that it is not well-formed."""

    def __init__(self, message: str, place: FileLine, *, is_syntax: bool = False) -> None:
        super().__init__(message)
        self.place = place
        self.is_syntax = is_syntax


class _Keeper:
    """Lets clones of an element know where the element was written."""

    def handle(self, operation: int, key: str, data: Any, src: Any, dst: Any) -> None:
        del operation, src
        if dst is not None:
            # minidom copies user data to clones, so an element that a macro produces still knows
            # its line.
            dst.setUserData(key, data, self)


_KEEPER = _Keeper()


class _Builder(expatbuilder.ExpatBuilderNS):
    """Builds a tree whose elements know their place."""

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        element.setUserData(_KEY, (self.file, self.getParser().CurrentLineNumber), _KEEPER)

    def character_data_handler_cdata(self, data: str) -> None:
        super().character_data_handler_cdata(data)
        text: Any = self.curNode.lastChild
        if not data.isspace() and text is not None and text.getUserData(_KEY) is None:
            # expat reports a text where it ends
            line = self.getParser().CurrentLineNumber - data.lstrip().count("\n")
            text.setUserData(_KEY, (self.file, line), _KEEPER)

    def start_doctype_decl_handler(self, *args: Any, **more: Any) -> None:
        raise BadFileError(
            "the document has a DOCTYPE; none is allowed", (self.file, self.getParser().CurrentLineNumber)
        )


def parse(data: bytes, file: str) -> minidom.Document:
    """The tree of a file.

    Raises:
        BadFileError: it is not well-formed, or has what no robot needs.
    """
    if data.count(b"<") > _MOST_TAGS:
        raise BadFileError(f"the file has more than {_MOST_TAGS:,} tags", (file, 1))
    try:
        return _Builder(file).parseString(data)
    except ExpatError as error:
        raise BadFileError(f"not well-formed XML: {error}", (file, error.lineno), is_syntax=True) from error


def place_of(node: Any) -> FileLine | None:
    """Where a node, or the nearest one around it, was written."""
    while node is not None:
        source = node.getUserData(_KEY)
        if source:
            return source
        node = node.parentNode
    return None


def places_below(root: Any) -> Iterator[FileLine | None]:
    """The places of all elements in the order of the document; no recursion, since the document may be deep."""
    stack = [root]
    while stack:
        element = stack.pop()
        yield element.getUserData(_KEY)
        stack.extend(node for node in reversed(element.childNodes) if node.nodeType == node.ELEMENT_NODE)


def included_texts(root: Any) -> Iterator[tuple[str, str, int]]:
    """The texts that were written in another file than the element that they are in now, with their places."""
    for element in root.getElementsByTagName("*"):
        yield from _texts_in(element)
    yield from _texts_in(root)


def _texts_in(element: Any) -> Iterator[tuple[str, str, int]]:
    around = element.getUserData(_KEY)
    for node in element.childNodes:
        source = node.getUserData(_KEY) if node.nodeType == node.TEXT_NODE else None
        if source and around and source[0] != around[0] and not node.data.isspace():
            yield (node.data.strip(), *source)
