"""The text of a file and the bytes that it came from: encoding, byte order mark and line ends stay as they are."""

import codecs
import re
from dataclasses import dataclass
from typing import Self

_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_DECLARED = re.compile(rb"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([A-Za-z][\w.-]*)["']""")
_WITHOUT_MARK = ((b"<\0", "utf-16-le"), (b"\0<", "utf-16-be"))
"""How UTF-16 begins where it has no mark."""


class UndecodableError(ValueError):
    """Bytes that are no text in the encoding that the file declares, or an encoding that is not known."""


@dataclass(frozen=True, slots=True)
class SourceText:
    """A decoded file. `data` gives its bytes again; line ends in `text` are those of the file."""

    text: str
    encoding: str = "utf-8"
    mark: bytes = b""

    @classmethod
    def of(cls, data: bytes) -> Self:
        """The text of a file.

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
        """The bytes of the file; a character that its encoding does not have is written as a reference."""
        return self.mark + self.text.encode(self.encoding, "xmlcharrefreplace")

    @property
    def line_end(self) -> str:
        """What ends a line: that of the first one."""
        end = self.text.find("\n")
        return "\r\n" if end > 0 and self.text[end - 1] == "\r" else "\n"

    def with_text(self, text: str) -> Self:
        """Another text, in the same encoding."""
        return type(self)(text, self.encoding, self.mark)


def _encoding(data: bytes) -> tuple[bytes, str]:
    """The byte order mark and the name of the encoding."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return mark, encoding
    for begin, encoding in _WITHOUT_MARK:
        if data.startswith(begin):
            return b"", encoding
    declared = _DECLARED.match(data)
    return b"", declared[1].decode() if declared else "utf-8"
