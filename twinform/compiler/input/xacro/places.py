"""Places in xacro files: elements that know their file and line, and where properties and macros are defined."""

from collections.abc import Callable, Iterator, Sequence
from os.path import basename
from typing import Any, NamedTuple
from xml.dom import expatbuilder, minidom
from xml.parsers.expat import ExpatError

_MOST_TAGS = 1_000_000
_KEY = "source"
_NUMBER = "number"
_CALL = "call"

FileLine = tuple[str, int]
PartPlace = tuple[str, int, int, int]
"""A file and line, the number of the element in the file from 0, and that of the call in which it was evaluated."""


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
        self.count = 0

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        element.setUserData(_KEY, (self.file, self.getParser().CurrentLineNumber), _KEEPER)
        element.setUserData(_NUMBER, self.count, _KEEPER)
        self.count += 1

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


def places_below(root: Any) -> Iterator[PartPlace | None]:
    """The places of all elements in the order of the document; no recursion, since the document may be deep."""
    stack = [root]
    while stack:
        element = stack.pop()
        source = element.getUserData(_KEY)
        yield (*source, element.getUserData(_NUMBER), element.getUserData(_CALL) or 0) if source else None
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


class Call(NamedTuple):
    """A macro that is being expanded, where it is called, and the number of the call from 1."""

    macro: str
    place: FileLine
    number: int


class Definitions:
    """The definitions so far; `files` returns those that are being read, the outermost first."""

    def __init__(self, files: Callable[[], Sequence[str]]) -> None:
        self.here: FileLine | None = None
        self.properties: dict[str, FileLine | None] = {}
        self.macros: dict[str, FileLine | None] = {}
        self.calls: list[Call] = []
        self.made: list[tuple[str, int, int]] = []
        """All calls so far: the file, the number of the element in it, and that of the call around it, or 0."""
        self.files = files

    def note(self, function: str, node: Any) -> None:
        """Note the element, and the definition, that a function of xacro is about to read."""
        self.here = place_of(node)
        if function == "eval_all" and node.getUserData(_CALL) is None:
            # A block is evaluated where it is written first, and then once more where it is inserted.
            node.setUserData(_CALL, self._call, _KEEPER)
        known = {"grab_property": self.properties, "grab_macro": self.macros}.get(function)
        if known is not None:
            known[node.getAttribute("name").removeprefix("xacro:")] = self.here

    def begin_call(self, node: Any) -> bool:
        """Note a call, if the element is one."""
        place = place_of(node)
        if place is None or not node.tagName.startswith("xacro:"):
            return False
        self.made.append((place[0], node.getUserData(_NUMBER), self._call))
        self.calls.append(Call(node.tagName.removeprefix("xacro:"), place, len(self.made)))
        return True

    @property
    def _call(self) -> int:
        return self.calls[-1].number if self.calls else 0

    def around(self) -> str:
        """Say which macro is being expanded, and where it is called."""
        # The parameters of a call are evaluated outside of the macro.
        inside = [call for call in self.calls if call.macro in self.macros and call.place != self.here]
        if not inside:
            return ""
        macro, (file, line), _ = inside[-1]
        return f" (in macro {macro!r}, called at {basename(file)}:{line})"

    def circle(self) -> str:
        """Say which files include each other, or which macros call each other; empty where none do."""
        files = _circle([basename(file) for file in self.files()])
        if files:
            return f"{files[0]} includes {', which includes '.join(files[1:])}"
        macros = [repr(name) for name in _circle([call.macro for call in self.calls])]
        if len(macros) == 2:
            return f"macro {macros[0]} calls itself without an end"
        return f"macro {macros[0]} calls {', which calls '.join(macros[1:])}, without an end" if macros else ""


def _circle(names: Sequence[str]) -> list[str]:
    """Return the names from one to where it comes again, beginning with the outermost of them."""
    last = {name: i for i, name in enumerate(names)}
    start = next((i for i, name in enumerate(names) if last[name] > i), None)
    if start is None:
        return []
    return [*names[start : names.index(names[start], start + 1)], names[start]]
