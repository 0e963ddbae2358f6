"""Columns of findings: finds the piece of the text that a finding is about, from its line and path.

It is only done on demand, for files with findings. A finding keeps its line without a column where it is in doubt which
piece is meant.
"""

from bisect import bisect_left
from collections import defaultdict
from dataclasses import field, replace
from functools import cached_property

from twinform.compiler.input.finding_lines import PartFinder
from twinform.compiler.input.finding_pieces import piece, quoted, values
from twinform.compiler.input.load_options import LoadResult, expanded_name
from twinform.compiler.input.loading import garbage_collection_paused, read_tree_again
from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.compiler.input.size_limits import LIFTED_LIMITS
from twinform.compiler.input.source_files import SourceFiles
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Span, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import LAST_LINE, XmlElement
from twinform.text import ElementSpan, Lines, SourceText
from twinform.text.positions import Tags, start_tag

_WORD = lazy_pattern(r"[\w:.-]+")
_OF_ROOT = frozenset({rules.UNKNOWN_ROOT, rules.OLD_ROOT})
"""Findings about the root element, whatever its name is."""
# libxml2 knows the line on which a start tag ends, and findings are made with that, which costs
# nothing. Columns take 0.24 s for 1,000 findings in a file of 10,000 links, whose check takes 0.7
# s. expat would need 3.0 s and refuses what is repaired, so one regular expression finds the tags.
_MOST_ON_LINE = 1000


def located(loaded: LoadResult) -> tuple[Diagnostic, ...]:
    """Return the findings about a file with columns, in the order of the file."""
    return with_columns(loaded.diagnostics, SourceFiles.of(loaded))


def with_columns(diagnostics: tuple[Diagnostic, ...], files: SourceFiles) -> tuple[Diagnostic, ...]:
    """Return findings with columns, sorted by file and line; `files` are the files that they are about."""
    texts: dict[str, FindingSpans | None] = {}
    with garbage_collection_paused():
        found = [_with_column(each, files, texts) for each in diagnostics]
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
        line = finding.location.line
        if not 0 < line <= len(self.lines):
            return None
        around = bisect_left(self.tags.starts, self.lines.start(line)) - 1  # its start tag may go on here
        before = [self.tags.element(around)] if around >= 0 else []
        found = [
            attribute.value
            for element in (*before, *self._elements_beginning_on(line))
            for name, attribute in element.attributes.items()
            if f"'{name}'" in finding.message and self.lines.place(attribute.name.start).line == line
        ]
        return found[0] if len(found) == 1 else None


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
    return all(
        place == 0 or str(element.tag).rpartition("}")[2] == tags.name(place).rpartition(":")[2]
        for element, place in places.items()
    )
