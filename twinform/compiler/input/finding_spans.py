"""Columns of findings: finds the piece of the text that a finding is about, from its line and path.

The text is that of the file that was read, or of one that it includes or comes from.
"""

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property
from pathlib import Path

from twinform.compiler.input.finding_lines import PartFinder, piece, quoted, values
from twinform.compiler.input.load_options import LoadResult, expanded_name
from twinform.compiler.input.loading import garbage_collection_paused, read_tree_again
from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.compiler.input.size_limits import LARGEST, LIFTED_LIMITS
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Span, rules
from twinform.diagnostics.rules import XACRO_REFUSED
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.schemas import LAST_LINE, XmlElement
from twinform.text import ElementSpan, Lines, SourceText
from twinform.text.positions import Tags, start_tag

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


_WORD = lazy_pattern(r"[\w:.-]+")
_OF_ROOT = frozenset({rules.UNKNOWN_ROOT, rules.OLD_ROOT})
"""Findings about the root element, whatever its name is."""
# libxml2 knows the line on which a start tag ends, and findings are made with that, which costs
# nothing. Columns take 0.24 s for 1,000 findings in a file of 10,000 links, whose check takes 0.7
# s. expat would need 3.0 s and refuses what is repaired, so one regular expression finds the tags.
_MOST_ON_LINE = 1000
_MJCF = "/mujoco/"


def located(loaded: LoadResult) -> tuple[Diagnostic, ...]:
    """Return the findings about a file with columns, in the order of the file."""
    return with_columns(loaded.diagnostics, SourceFiles.of(loaded))


def with_columns(diagnostics: tuple[Diagnostic, ...], files: SourceFiles) -> tuple[Diagnostic, ...]:
    """Return findings with columns, sorted by file and line; `files` are the files that they are about."""
    texts: dict[str, FindingSpans | None] = {}
    with garbage_collection_paused():
        found = [_without_spliced(_with_column(each, files, texts)) for each in diagnostics]
    order = {file: number for number, file in enumerate(dict.fromkeys(each.location.file for each in found))}
    return tuple(sorted(found, key=lambda each: (order[each.location.file], each.location.line, each.location.column)))


def _with_column(one: Diagnostic, files: SourceFiles, texts: dict[str, "FindingSpans | None"]) -> Diagnostic:
    where = one.location
    if where.column and not where.end_line:
        return replace(one, location=_with_end(where, files))
    if where.column or not (where.line or where.path):
        return one
    if where.file not in texts:
        data = files.data(where.file)
        texts[where.file] = FindingSpans.of(data, files.trees.get(where.file)) if data else None
    place = texts[where.file]
    span = place and place.piece(one, expanded=_is_expanded(one))
    return replace(one, location=place.location(where, span)) if place and span else one


def _with_end(where: Location, files: SourceFiles) -> Location:
    """Extend a place from another program to the end of the word there."""
    word = _WORD.match(files.line(where.file, where.line) or "", where.column - 1)
    return where._replace(end_line=where.line, end_column=word.end() + 1) if word else where


def _is_expanded(one: Diagnostic) -> bool:
    """Whether a finding is about the expansion of a xacro file, where it has a second place."""
    return bool(one.related) and one.related[0].file.endswith(expanded_name(""))


def _without_spliced(one: Diagnostic) -> Diagnostic:
    """Leave out the place in a text that nobody can see: MJCF with what it includes, or a place without a line."""
    if not _is_expanded(one):
        return one
    is_spliced = f"{one.related[0].path}/".startswith(_MJCF)
    return replace(one, related=one.related[1:]) if is_spliced or not one.related[0].line else one


@dataclass(frozen=True)  # no slots: the lines are kept in the dictionary
class FindingSpans:
    """Finds the pieces of one file that findings are about."""

    tags: Tags
    parts: PartFinder
    places: dict[XmlElement, int] = field(repr=False)

    @classmethod
    def of(cls, data: bytes, tree: XmlElement | None = None) -> "FindingSpans | None":
        """Prepare the search in a file, whose tree may be at hand; None where the file cannot be read."""
        try:
            root = _parse_again(data) if tree is None else tree
            tags = Tags(SourceText.of(data).text)
            places = dict(zip(root.iter("*"), range(len(tags)), strict=True))
        except (UnreadableError, ValueError):  # also: not the same elements; a codec that knows its own errors
            return None
        return cls(tags, PartFinder(root), places) if _have_equal_tags(places, tags) else None

    @property
    def text(self) -> str:
        """The text of the file."""
        return self.tags.text

    @cached_property
    def lines(self) -> Lines:
        """The lines of the text."""
        return Lines(self.text)

    def span(self, where: Location) -> Span | None:
        """Return the attribute or start tag that a location leads to; None where it leads to no element.

        For an attribute that is not written it is the start tag.
        """
        element = self.parts.find(where)
        if element is None:
            return None
        place = self._element(element)
        attribute = place.attributes.get(where.path.rpartition("/@")[2]) if "/@" in where.path else None
        return attribute.whole if attribute else place.start_tag

    def piece(self, finding: Diagnostic, *, expanded: bool = False) -> Span | None:
        """Return the smallest piece that a finding is about; None where that is in doubt.

        The path of a finding about `expanded` content may lead elsewhere in the source.
        """
        where = finding.location
        if finding.rule is rules.TABBED_NUMBERS:
            return self._tabbed_value(finding)
        if finding.rule in _OF_ROOT:
            return start_tag(self.text, self.tags.starts[0]).name
        element = self.parts.find(where)
        # Beyond line 65,535 libxml2 stops counting, and the path alone decides.
        if element is None and (not where.line or where.line > LAST_LINE):
            element = self.parts.find_path(where)
        if element is not None:
            return piece(finding, self._element(element), self.text)
        if not where.path:
            return self._quoted_on_line(finding)
        place = self._only_match_on_line(where) if expanded else None
        return piece(finding, place, self.text) if place else self._found_below(finding)

    def location(self, where: Location, span: Span) -> Location:
        """Return a location with the lines and columns of a piece."""
        (line, column), (end_line, end_column) = self.lines.place(span.start), self.lines.place(span.end)
        return where._replace(line=line, column=column, end_line=end_line, end_column=end_column)

    def _element(self, element: XmlElement) -> ElementSpan:
        return self.tags.element(self.places[element])

    def _elements_beginning_on(self, line: int) -> list[ElementSpan]:
        """Return the elements that begin on a line, or nothing where there are too many to search."""
        if not 0 < line <= len(self.lines):
            return []
        begin = self.lines.start(line)
        end = self.lines.start(line + 1) if line < len(self.lines) else len(self.text)
        places = range(bisect_left(self.tags.starts, begin), bisect_left(self.tags.starts, end))
        return [self.tags.element(place) for place in places] if len(places) <= _MOST_ON_LINE else []

    def _only_match_on_line(self, where: Location) -> ElementSpan | None:
        """Return the only element on a line that has the tag, and the attribute, which a path ends with."""
        path, _, attribute = where.path.partition("/@")
        tag = path.rpartition("/")[2].partition("[")[0] if "']" not in path else _last_tag(path)
        found = [
            each
            for each in self._elements_beginning_on(where.line)
            if each.name.of(self.text) == tag and (not attribute or attribute in each.attributes)
        ]
        return found[0] if len(found) == 1 else None

    def _found_below(self, finding: Diagnostic) -> Span | None:
        """Return the only text or value equal to what was found, on the line of a finding and below its path."""
        where, found = finding.location, finding.found
        around = self.parts.find_path(where)
        if around is None or not found:
            return None
        here = self._elements_by_line.get(where.line, [])
        if len(here) > _MOST_ON_LINE:
            return None
        pieces = [
            span
            for element in here
            if element is around or around in element.iterancestors()
            for span in values(self._element(element), self.text)
            if span.of(self.text) == found
        ]
        return pieces[0] if len(pieces) == 1 else None

    @cached_property
    def _elements_by_line(self) -> dict[int | None, list[XmlElement]]:
        found: defaultdict[int | None, list[XmlElement]] = defaultdict(list)
        for element in self.places:
            found[element.sourceline].append(element)
        return found

    def _quoted_on_line(self, finding: Diagnostic) -> Span | None:
        """Return what the message of a finding quotes, in the only element that begins on its line."""
        found = self._elements_beginning_on(finding.location.line)
        if len(found) != 1:
            return None
        return quoted(finding.message, found[0], self.text) or found[0].name

    def _tabbed_value(self, finding: Diagnostic) -> Span | None:
        """Return the value of the only attribute on a line that the message names."""
        values = self._values_on(finding.location.line)
        found = [span for name, spans in values.items() if f"'{name}'" in finding.message for span in spans]
        return found[0] if len(found) == 1 else None

    def _values_on(self, line: int) -> dict[str, list[Span]]:
        """Return the values of the attributes on a line by their names, at most two of each."""
        if line not in self._values:
            found = self._values[line] = defaultdict[str, list[Span]](list)
            if 0 < line <= len(self.lines):
                around = bisect_left(self.tags.starts, self.lines.start(line)) - 1  # its start tag may go on here
                before = [self.tags.element(around)] if around >= 0 else []
                for element in (*before, *self._elements_beginning_on(line)):
                    for name, attribute in element.attributes.items():
                        if len(found[name]) < _UNCLEAR and self.lines.place(attribute.name.start).line == line:
                            found[name].append(attribute.value)
        return self._values[line]

    @cached_property
    def _values(self) -> dict[int, dict[str, list[Span]]]:
        return {}


_UNCLEAR = 2
"""So many values of one name leave in doubt which of them is meant."""


def _last_tag(path: str) -> str:
    """Return the tag of the element that a path ends with; names in the path may have slashes in them."""
    steps = path.split("']")
    last = steps[-1] or steps[-2].partition("[@")[0]
    return last.rpartition("/")[2].partition("[")[0]


def _parse_again(data: bytes) -> XmlElement:
    """Parse a file again as it was read, or as XML of another format.

    Raises:
        UnreadableError: it is not XML.
    """
    try:
        return read_tree_again(data)
    except UnreadableError:
        return parse(data, DiagnosticSink(), LIFTED_LIMITS)


def _have_equal_tags(places: dict[XmlElement, int], tags: Tags) -> bool:
    """Whether the elements have the same names in the tree and in the text, except for prefixes and old roots."""
    names = [element.tag for element in places]
    return names == tags.names or all(
        place == 0 or str(name).rpartition("}")[2] == written.rpartition(":")[2]
        for place, (name, written) in enumerate(zip(names, tags.names, strict=True))
    )
