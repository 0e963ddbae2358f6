"""The documents open in the editor, in step with what is typed: the files that they name, and what is at the cursor."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import Enum, auto
from functools import cached_property
from pathlib import Path

from lsprotocol.types import PositionEncodingKind, TextDocumentContentChangeEvent, TextDocumentContentChangePartial

from twinform.compiler.input.load_options import XACRO
from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.server.checking import LARGEST, MOST_TAGS
from twinform.server.locations import Positions, file_of, path_of, uri_of
from twinform.server.model_text import ModelText
from twinform.server.tolerant_tree import TolerantNode
from twinform.text import SourceText, UndecodableError

_DECLARED = lazy_pattern(r"""\s*<\?xml[^>]{0,200}?\sencoding\s*=\s*["']([A-Za-z][\w.-]*)["']""")
_LONE = lazy_pattern("[\ud800-\udfff]")


@dataclass(frozen=True)  # no slots: what is made of the text is kept in the dictionary
class TextDocument(ModelText):
    """One state of a document; each edit makes another one.

    `excess` says why a document is not followed; its text is empty then.
    """

    encoding: PositionEncodingKind = PositionEncodingKind.Utf16
    excess: str = ""

    @cached_property
    def path(self) -> Path:
        """The file of the document; a made-up name if its URI is not that of a file on this machine."""
        return path_of(self.uri)

    @cached_property
    def is_file(self) -> bool:
        """Whether the document is a file on this machine, which others can include."""
        return file_of(self.uri) is not None

    @cached_property
    def positions(self) -> Positions:
        """The positions of its lines."""
        return Positions.of(self.text, self.encoding)

    @property
    def is_xacro(self) -> bool:
        """Whether it is a xacro file, which is expanded before it is read."""
        return self.path.name.lower().endswith(XACRO)

    @cached_property
    def data(self) -> bytes:
        """The bytes of the document if it were saved, with lone surrogates replaced."""
        declared = _DECLARED.match(self.text)
        encoding = declared[1] if declared else "utf-8"
        # An editor that counts in UTF-16 may send half of a surrogate pair between two keys.
        text = _LONE.sub("\ufffd", self.text)
        try:
            return SourceText(text, encoding).data
        except (LookupError, UnicodeError):  # which the check reports
            return text.encode()


def excess_of(text: str) -> str:
    """Say why a text is too large to be followed; empty if it is not."""
    if len(text) > LARGEST:
        return f"the file has more than {LARGEST >> 20} MiB"
    tags = text.count("<")
    return f"the file has {tags:,} tags" if tags > MOST_TAGS else ""


class Documents:
    """All documents that are open, by their URIs."""

    def __init__(self) -> None:
        self.encoding = PositionEncodingKind.Utf16
        self._open: dict[str, TextDocument] = {}
        self._good: dict[str, TextDocument] = {}

    def __iter__(self) -> Iterator[TextDocument]:
        return iter(tuple(self._open.values()))

    def get(self, uri: str) -> TextDocument | None:
        """Return the document of a URI, if it is open and followed."""
        found = self._open.get(uri)
        return None if found is None or found.excess else found

    def state(self, uri: str) -> TextDocument | None:
        """Return the document of a URI, if it is open, even if it is not followed."""
        return self._open.get(uri)

    def of_path(self, path: Path) -> TextDocument | None:
        """Return the open document of a file."""
        return next((each for each in self if each.is_file and each.path == path and not each.excess), None)

    def last_good(self, document: TextDocument) -> TextDocument | None:
        """Return the last state of a document that was parsed and well-formed."""
        return document if document.tree.whole else self._good.get(document.uri)

    def follow(self, uri: str, text: str, version: int, language: str) -> TextDocument:
        """Keep a text as the state of a document."""
        last = self._open.get(uri)
        if last is not None:
            self._leave(last)
        # A text that is too large is kept as a document without content, so that its closing and
        # shrinking are still followed.
        excess = excess_of(text)
        made = TextDocument(uri, "" if excess else text, version, language, self.encoding, excess)
        self._open[uri] = made
        return made

    def change(self, uri: str, changes: Iterable[TextDocumentContentChangeEvent], version: int) -> TextDocument | None:
        """Apply the changes of the editor to a document; None if it is not open."""
        document = self._open.get(uri)
        if document is None:
            return None
        for change in changes:
            if not isinstance(change, TextDocumentContentChangePartial):
                document = self.follow(uri, change.text, version, document.language)
            elif not document.excess:
                start, end = document.positions.span(change.range)
                text = document.text[:start] + change.text + document.text[end:]
                document = self.follow(uri, text, version, document.language)
            else:
                document = self._open[uri] = replace(document, version=version)
        return document

    def close(self, uri: str) -> None:
        """Forget a document."""
        self._open.pop(uri, None)
        self._good.pop(uri, None)

    def _leave(self, last: TextDocument) -> None:
        """Keep a state as the last well-formed one, or release its tree."""
        if last.is_parsed and last.tree.whole:
            last, self._good[last.uri] = self._good.get(last.uri, last), last
        if last is not self._good.get(last.uri):
            last.release()


_MOST_FILES = 500
"""The most files that are cached."""


class DocumentFiles:
    """Documents by their files: open ones with the text of the editor, others read from the disk and cached."""

    def __init__(self, documents: Documents) -> None:
        self._documents = documents
        self._read: dict[Path, tuple[tuple[int, int], TextDocument]] = {}

    def document(self, path: Path) -> TextDocument | None:
        """Return the document of a file; None if the file cannot be read, is no text, or is too large."""
        found = self._documents.of_path(path)
        return found if found is not None else self._read_file(path)

    def _read_file(self, path: Path) -> TextDocument | None:
        try:
            status = path.stat()
            state = (status.st_mtime_ns, status.st_size)
            if path in self._read and self._read[path][0] == state:
                return self._read[path][1]
            if status.st_size > LARGEST:
                return None
            text = SourceText.of(Readable.of(path).read(path, LARGEST)).text
        except (OSError, ValueError, UndecodableError):
            return None
        if excess_of(text):
            return None
        if len(self._read) >= _MOST_FILES:
            self._read.clear()
        document = TextDocument(uri_of(path), text, encoding=self._documents.encoding)
        self._read[path] = (state, document)
        return document


_BLANKS = " \t\r\n"


class CursorKind(Enum):
    """Which kind of part a cursor is in."""

    TAG = auto()
    """The name of an element in its start tag, which may still be typed."""
    ATTRIBUTE = auto()
    """The name of an attribute, or a place in a start tag where one may begin."""
    VALUE = auto()
    """Between the quotes of an attribute."""
    END_TAG = auto()
    """In an end tag."""
    TEXT = auto()
    """Between tags."""


@dataclass(frozen=True, slots=True)
class Cursor:
    """A place in a document, and the `piece` of text around it.

    `node` is the element whose tag it is in, or the one around a text; None outside of all elements. `attribute` is the
    attribute whose name or value it is in.
    """

    kind: CursorKind
    node: TolerantNode | None
    piece: Span
    attribute: str | None = None


def cursor_at(document: TextDocument, offset: int) -> Cursor | None:
    """Find the part of a document at an offset; None in a comment, CDATA section or processing instruction."""
    tree = document.tree
    if tree.aside_at(offset) is not None:
        return None
    node = tree.at(offset)
    if node is None:
        return Cursor(CursorKind.TEXT, None, Span(offset, offset))
    if node.start < offset <= _inside_end(node):
        return _in_start_tag(node, offset, document.text)
    if node.end_tag is not None and node.end_tag.start < offset:
        return Cursor(CursorKind.END_TAG, node, Span(node.end_tag.start + 2, node.end_tag.start + 2 + len(node.tag)))
    return Cursor(CursorKind.TEXT, node, _run_of_text(node, offset, document.text))


def _inside_end(node: TolerantNode) -> int:
    """Return the last place in a start tag, before its `>` or `/>`."""
    closing = (2 if node.empty else 1) if node.whole_tag else 0
    return node.start_tag.end - closing


def _in_start_tag(node: TolerantNode, offset: int, text: str) -> Cursor:
    if offset <= node.name.end:
        return Cursor(CursorKind.TAG, node, node.name)
    for name, span in node.attributes.items():
        if span.name.start <= offset <= span.name.end:
            return Cursor(CursorKind.ATTRIBUTE, node, span.name, name)
        quoted = span.value.start > span.name.end and text[span.value.start - 1] in "\"'"
        if quoted and span.value.start <= offset <= span.value.end:
            return Cursor(CursorKind.VALUE, node, span.value, name)
    return Cursor(CursorKind.ATTRIBUTE, node, Span(offset, offset))


def _run_of_text(node: TolerantNode, offset: int, text: str) -> Span:
    """Return the text around a place, up to the next tags, without blanks at its ends."""
    inside = node.content
    start = max(text.rfind(">", inside.start, offset) + 1, inside.start)
    end = text.find("<", offset, inside.end)
    end = inside.end if end < 0 else end
    while start < offset and text[start] in _BLANKS:
        start += 1
    while end > offset and text[end - 1] in _BLANKS:
        end -= 1
    return Span(start, end)
