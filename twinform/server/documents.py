"""The documents that are open in the editor: their texts, kept in step with what is typed there."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from lsprotocol.types import PositionEncodingKind, TextDocumentContentChangeEvent, TextDocumentContentChangePartial

from twinform.server.editor_uris import file_of, path_of
from twinform.server.positions import Positions
from twinform.server.schema import FormatName, Schema, format_of
from twinform.server.settings import LARGEST, MOST_TAGS
from twinform.server.tolerant_tree import Tree, parse
from twinform.text import SourceText

Made = TypeVar("Made")
_DECLARED = re.compile(r"""\s*<\?xml[^>]{0,200}?\sencoding\s*=\s*["']([A-Za-z][\w.-]*)["']""")
_LONE = re.compile("[\ud800-\udfff]")


@dataclass(frozen=True)  # no slots: what is made of the text is kept in the dictionary
class TextDocument:
    """One state of a text. It is never changed: each key makes another one.

    `excess` tells why it is not followed; its text is empty then.
    """

    uri: str
    text: str
    version: int | None = None
    language: str = ""
    encoding: PositionEncodingKind = PositionEncodingKind.Utf16
    excess: str = ""

    @cached_property
    def path(self) -> Path:
        """The file; what is no file of this machine has a name like that in its URI."""
        return path_of(self.uri)

    @cached_property
    def is_file(self) -> bool:
        """Whether it is a file of this machine, which others can include."""
        return file_of(self.uri) is not None

    @cached_property
    def positions(self) -> Positions:
        """Where its lines are."""
        return Positions.of(self.text, self.encoding)

    @property
    def is_parsed(self) -> bool:
        """Whether anybody has asked for its tree."""
        return "tree" in self.__dict__

    @cached_property
    def tree(self) -> Tree:
        """Its elements, however much is missing."""
        return parse(self.text)

    def once(self, make: "Callable[[TextDocument], Made]") -> "Made":
        """What a function makes of it, made once."""
        known: dict[object, Any] = self.__dict__.setdefault("made", {})
        if make not in known:
            known[make] = make(self)
        return known[make]

    def release(self) -> None:
        """Give up the tree, whose elements hold each other: to find that out takes the garbage collector longer."""
        if self.is_parsed:
            self.tree.release()

    @cached_property
    def schema(self) -> Schema:
        """What its elements are by the facts tables."""
        return Schema(self.tree, self.format)

    @property
    def format(self) -> FormatName | None:
        """The format that it is in: that of its root, or else the one that its name promises."""
        return format_of(self.tree, self.path.name, self.language)

    @property
    def is_xacro(self) -> bool:
        """Whether it is expanded before it is read."""
        return self.path.suffix.lower() == ".xacro"

    @cached_property
    def data(self) -> bytes:
        """The bytes of the file that it would be; what is half a character becomes a whole one."""
        declared = _DECLARED.match(self.text)
        encoding = declared[1] if declared else "utf-8"
        # An editor that counts in UTF-16 may send half of a surrogate pair between two keys.
        text = _LONE.sub("\ufffd", self.text)
        try:
            return SourceText(text, encoding).data
        except (LookupError, UnicodeError):  # which the check reports
            return text.encode()


def excess_of(text: str) -> str:
    """Why a text is not followed; empty for one that is."""
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
        """The document of a URI, if it is open and followed."""
        found = self._open.get(uri)
        return None if found is None or found.excess else found

    def state(self, uri: str) -> TextDocument | None:
        """Return what is known of a document, also of one that is not followed."""
        return self._open.get(uri)

    def of_path(self, path: Path) -> TextDocument | None:
        """The document that is open of a file."""
        return next((each for each in self if each.is_file and each.path == path and not each.excess), None)

    def last_good(self, document: TextDocument) -> TextDocument | None:
        """The last state of a document that was well-formed, as far as anybody has looked at it."""
        return document if document.tree.whole else self._good.get(document.uri)

    def open(self, uri: str, text: str, version: int, language: str) -> TextDocument:
        """Take up a document."""
        return self._keep(uri, text, version, language)

    def change(self, uri: str, changes: Iterable[TextDocumentContentChangeEvent], version: int) -> TextDocument | None:
        """Do what was done in the editor; None for what is not open."""
        document = self._open.get(uri)
        if document is None:
            return None
        for change in changes:
            if not isinstance(change, TextDocumentContentChangePartial):
                document = self._keep(uri, change.text, version, document.language)
            elif not document.excess:
                start, end = document.positions.span(change.range)
                text = document.text[:start] + change.text + document.text[end:]
                document = self._keep(uri, text, version, document.language)
            else:
                document = self._open[uri] = replace(document, version=version)
        return document

    def close(self, uri: str) -> None:
        """Forget a document."""
        self._open.pop(uri, None)
        self._good.pop(uri, None)

    def _keep(self, uri: str, text: str, version: int, language: str) -> TextDocument:
        last = self._open.get(uri)
        if last is not None:
            self._leave(last)
        # A text that is too large is kept as a document without content, so that its closing and
        # shrinking are still followed.
        excess = excess_of(text)
        made = TextDocument(uri, "" if excess else text, version, language, self.encoding, excess)
        self._open[uri] = made
        return made

    def _leave(self, last: TextDocument) -> None:
        """Go on from a state: it is kept as the last good one, or let go."""
        if last.is_parsed and last.tree.whole:
            last, self._good[last.uri] = self._good.get(last.uri, last), last
        if last is not self._good.get(last.uri):
            last.release()
