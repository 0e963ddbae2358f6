"""The text of a file and the bytes that it came from; edits that are applied to it, and its unified diff."""

import codecs
from collections.abc import Iterable, Iterator
from typing import Self

from twinform.dataclass import dataclass
from twinform.diagnostics import TextEdit
from twinform.diagnostics.reporters import printable
from twinform.lazy import lazy_pattern

_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_DECLARED = lazy_pattern(rb"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([A-Za-z][\w.-]*)["']""")
_WITHOUT_MARK = ((b"<\0", "utf-16-le"), (b"\0<", "utf-16-be"))
"""How UTF-16 begins where it has no mark."""


class UndecodableError(ValueError):
    """The bytes cannot be decoded by the encoding that the file declares, or the encoding is unknown."""


@dataclass(frozen=True, slots=True)
class SourceText:
    """A decoded file that `data` encodes again; its line ends stay as they are in the file."""

    text: str
    encoding: str = "utf-8"
    mark: bytes = b""

    @classmethod
    def of(cls, data: bytes) -> Self:
        """Decode a file.

        Raises:
            UndecodableError: it cannot be decoded.
        """
        mark, encoding = _encoding(data)
        try:
            return cls(data[len(mark) :].decode(encoding), encoding, mark)
        except (LookupError, UnicodeDecodeError) as error:
            raise UndecodableError(str(error)) from error

    @property
    def data(self) -> bytes:
        """The bytes of the file; a character that its encoding lacks becomes a character reference."""
        return self.mark + self.text.encode(self.encoding, "xmlcharrefreplace")

    @property
    def line_end(self) -> str:
        """The line end of the first line."""
        end = self.text.find("\n")
        return "\r\n" if end > 0 and self.text[end - 1] == "\r" else "\n"

    def with_text(self, text: str) -> Self:
        """Return the file with another text in the same encoding."""
        return type(self)(text, self.encoding, self.mark)


def _encoding(data: bytes) -> tuple[bytes, str]:
    """Return the byte order mark and the name of the encoding."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return mark, encoding
    for begin, encoding in _WITHOUT_MARK:
        if data.startswith(begin):
            return b"", encoding
    declared = _DECLARED.match(data)
    return b"", declared[1].decode() if declared else "utf-8"


class OverlapError(ValueError):
    """Two edits change the same piece."""


def apply(text: str, edits: Iterable[TextEdit]) -> str:
    """Apply edits to a text; several at one place are applied in the order given.

    Raises:
        OverlapError: two of them overlap.
    """
    pieces: list[str] = []
    here = 0
    for span, new, _ in sorted(edits, key=lambda edit: edit.span):
        if span.start < here:
            raise OverlapError(f"two edits overlap at offset {span.start}")
        pieces += (text[here : span.start], new)
        here = span.end
    return "".join((*pieces, text[here:]))


_NO_END = "\n\\ No newline at end of file\n"


def line_diff(name: str, before: str, after: str) -> Iterator[str]:
    """Yield the lines of a unified diff with their line ends; none if both texts are equal."""
    if before != after:
        from difflib import unified_diff  # noqa: PLC0415 - few runs print a diff

        for line in unified_diff(_lines(before), _lines(after), printable(name), printable(name)):
            yield line if line.endswith("\n") else line + _NO_END


def _lines(text: str) -> list[str]:
    r"""Split a text at `\n` alone, as `patch` and `git apply` do."""
    lines = [f"{line}\n" for line in text.split("\n")]
    return [*lines[:-1], lines[-1][:-1]] if lines[-1] != "\n" else lines[:-1]
