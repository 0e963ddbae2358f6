"""The texts of the files that findings are about: the file that was read, and those that it includes or comes from."""

from collections.abc import Mapping
from dataclasses import field
from pathlib import Path

from twinform.compiler.input.load_options import LoadResult
from twinform.compiler.input.size_limits import LARGEST
from twinform.dataclass import dataclass
from twinform.diagnostics.rules import XACRO_REFUSED
from twinform.file_access import Readable
from twinform.schemas import XmlElement
from twinform.text import Lines, SourceText

_BLANK = b"\xef\xbb\xbf\xff\xfe\0 \t\r\n"
"""The bytes that may stand before the first tag, in UTF-8 or UTF-16."""
_JSON_MARK = b"urn:twinform:document:"
_BEGINNING = 2**12


@dataclass(frozen=True, slots=True)
class SourceFiles:
    """The bytes and lines of files by their names in locations; each file is read once, on demand.

    `contents` has the files that are at hand, and `trees` what was parsed from them.
    """

    contents: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False)
    trees: Mapping[str, XmlElement] = field(default_factory=dict[str, XmlElement], repr=False)
    _read: dict[str, bytes | None] = field(default_factory=dict[str, bytes | None], repr=False)
    _lines: dict[str, tuple[str, Lines] | None] = field(default_factory=dict[str, tuple[str, Lines] | None], repr=False)

    _last: dict[tuple[str, int], str] = field(default_factory=dict[tuple[str, int], str], repr=False)

    @classmethod
    def of(cls, loaded: LoadResult) -> "SourceFiles":
        """Return the files of a result of reading; a xacro file that was refused is not opened."""
        if any(each.rule is XACRO_REFUSED for each in loaded.diagnostics):
            return cls(_read={loaded.path: None})
        was_made = any(name.startswith(f"{loaded.path} (") for name in loaded.origins)
        if was_made or loaded.content is None:
            return cls()
        trees = {} if loaded.tree is None else {loaded.path: loaded.tree}
        return cls({loaded.path: loaded.content}, trees)

    def data(self, file: str) -> bytes | None:
        """Return the bytes of a file; None where there is none, or it is too large."""
        found = self.contents.get(file)
        if found is not None or not file:
            return found
        if file not in self._read:
            self._read[file] = _data(file)
        return self._read[file]

    def line(self, file: str, number: int) -> str | None:
        """Return a line of a file, counted from 1, without its end; None where there is no such line."""
        if (file, number) in self._last:
            return self._last[file, number]
        found = self._lines_of(file)
        if found is None or not 0 < number <= len(found[1]):
            return None
        text, lines = found
        end = lines.start(number + 1) if number < len(lines) else len(text)
        self._last.clear()  # a file may be one long line, with a thousand findings
        self._last[file, number] = line = text[lines.start(number) : end].rstrip("\r\n")
        return line

    def place(self, file: str, offset: int) -> tuple[int, int] | None:
        """Return the line and column of an offset in a file; None where it has no such place."""
        found = self._lines_of(file)
        return found[1].place(offset) if found is not None and 0 <= offset <= len(found[0]) else None

    def _lines_of(self, file: str) -> tuple[str, Lines] | None:
        if file not in self._lines:
            self._lines[file] = self._text(file)
        return self._lines[file]

    def _text(self, file: str) -> tuple[str, Lines] | None:
        data = self.data(file)
        try:
            text = SourceText.of(data).text if data else None
        except ValueError:
            return None
        return (text, Lines(text)) if text is not None else None


def _data(file: str) -> bytes | None:
    path = Path(file)
    try:
        found = Readable.of(path).read(path, LARGEST)
    except (OSError, ValueError):
        return None
    return found if len(found) <= LARGEST and _is_model(found) else None


def _is_model(data: bytes) -> bool:
    """Whether a file is XML or one of our JSON documents: lines of other files are never shown."""
    return data.lstrip(_BLANK)[:1] in {b"<", b"?"} or _JSON_MARK in data[:_BEGINNING]
