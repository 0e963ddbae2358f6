"""The site of a finding for fixers: the file, the element and the attribute that it is about, and edits of them."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from twinform.compiler.fixing.expanded_editor import ExpandedEditor
from twinform.compiler.input.finding_lines import PartFinder
from twinform.compiler.input.front_ends import ROOTS, declared_version
from twinform.compiler.input.loading import LoadResult, read_tree_again
from twinform.compiler.input.parsing import UnreadableError
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Fix, Location, Safety, TextEdit
from twinform.lazy import lazy_pattern
from twinform.schemas import Fact, Version, XmlElement, rows_by_name, table
from twinform.text import (
    Editor,
    Lines,
    SourceText,
    TextSurroundings,
    UndecodableError,
    UnplacedError,
    masked,
    spans,
)
from twinform.text.tokens import require_well_formed

_EXPRESSION = lazy_pattern(r"\$[{(]")
_BETWEEN_WORDS = lazy_pattern(r"\s+|::|,")


@dataclass(frozen=True)
class FixableFile:
    """The text of a file that was read, its elements and their places; `parts` is None where the text is not XML.

    What a xacro file expands to has an editor that changes the xacro files.
    """

    loaded: LoadResult
    source: SourceText
    parts: PartFinder | None = None

    @classmethod
    def of(cls, loaded: LoadResult) -> "FixableFile | None":
        """Prepare a file for fixers; None for a document in memory and for JSON."""
        if loaded.content is None or (loaded.origins and loaded.expansion is None):
            return None
        try:
            source = SourceText.of(loaded.content)
        except UndecodableError:
            return None
        try:
            root = read_tree_again(loaded.content) if loaded.tree is None else loaded.tree
            require_well_formed(masked(source.text))
            file = cls(loaded, source, PartFinder(root))
            if loaded.expansion is None or file.expanded:
                return file
        except (UnreadableError, UnplacedError, ValueError, LookupError):
            return cls(loaded, source) if loaded.expansion is None else None
        return None

    @cached_property
    def edit(self) -> Editor:
        """The editor, which knows the place of each element."""
        # Most fixers look at the element first and have nothing to edit, and to find all places takes
        # as long as to read and check the file.
        if self.expanded is not None:
            return self.expanded
        if self.parts is None:
            return Editor(TextSurroundings("", "\n", ""), {})
        place = spans(masked(self.text))
        places = dict(zip(self.root.iter("*"), place.walk(), strict=True))
        return Editor(TextSurroundings.of(self.source, place), places)

    @cached_property
    def expanded(self) -> ExpandedEditor | None:
        """The editor of what xacro has made."""
        if self.loaded.expansion is None or self.parts is None:
            return None
        return ExpandedEditor.of(self.root, self.loaded.expansion, self.loaded.path)

    @property
    def root(self) -> XmlElement:
        """The root element."""
        assert self.parts is not None  # noqa: S101 - only what has elements asks for it
        return self.parts.root

    @property
    def text(self) -> str:
        """The text."""
        return self.source.text

    def text_of(self, edit: TextEdit) -> str:
        """Return the text that an edit changes."""
        return self.expanded.source_of(edit) if self.expanded else self.text

    @cached_property
    def lines(self) -> Lines:
        """The lines of the text."""
        return Lines(self.text)

    @cached_property
    def names(self) -> frozenset[str]:
        """The names of all elements."""
        return frozenset(each.get("name", "") for each in self.root.iter("*"))

    @cached_property
    def values(self) -> dict[str, list[tuple[XmlElement, str | None]]]:
        """The places of each value: attributes with their elements, and elements with a text."""
        found: defaultdict[str, list[tuple[XmlElement, str | None]]] = defaultdict(list)
        for each in self.root.iter("*"):
            for name, value in each.attrib.items():
                found[str(value).strip()].append((each, str(name)))
            if not len(each):
                found[(each.text or "").strip()].append((each, None))
        return found

    @cached_property
    def words(self) -> dict[str, set[str]]:
        """The words in texts, and in attributes other than `name`, with the tags of their elements."""
        found: defaultdict[str, set[str]] = defaultdict(set)
        for each in self.root.iter("*"):
            said = [str(value) for key, value in each.attrib.items() if key != "name"]
            for word in _BETWEEN_WORDS.split(" ".join((each.text or "", *said))):
                found[word].add(str(each.tag))
        return found

    @cached_property
    def memo(self) -> dict[str, Any]:
        """What fixers have found out about the whole file, so that they do so once for all findings."""
        return {}

    @cached_property
    def format(self) -> str:
        """`urdf`, `sdf` or `mjcf`."""
        return ROOTS[str(self.root.tag)][0]

    @cached_property
    def version(self) -> Version:
        """The version by which the document was read."""
        return declared_version(self.root, self.format, DiagnosticSink())

    def find(self, where: Location) -> XmlElement | None:
        """Return the element that a location leads to, which may be where the element was written."""
        if self.parts is None:
            return None
        if self.expanded is None or where.file == self.loaded.text_name:
            return self.parts.find(where)
        found = (self.parts.find(where._replace(line=each.sourceline or 0)) for each in self._written_at(where))
        return next((each for each in found if each is not None), None)

    def _written_at(self, where: Location) -> list[XmlElement]:
        """Return the elements that were written on the line of a location."""
        if "written" not in self.memo and self.expanded:
            by_place: defaultdict[tuple[str, int] | None, list[XmlElement]] = defaultdict(list)
            for each in self.expanded.places:
                by_place[self.expanded.place_of(each)].append(each)
            self.memo["written"] = by_place
        return self.memo["written"][where.file, where.line]

    def row_of(self, element: XmlElement) -> Fact | None:
        """Return the row of the facts table by which an element is read, with the rows of its content."""
        facts = table(self.format)
        here = facts.definitions[facts.root]
        for each in [*reversed([*element.iterancestors()]), element][1:]:
            row = rows_by_name(here.children, self.version).get(str(each.tag))
            if row is None:
                return None
            here = facts.resolve(row)
        return here


@dataclass(frozen=True)
class FindingSite:
    """A finding and its element; `attribute` is the attribute that its path names, whether it is written or not.

    Where the path leads to an element that is not written, `missing` is its tag, and `element` the one around it.
    """

    finding: Diagnostic
    file: FixableFile
    element: XmlElement
    attribute: str | None = None
    missing: str | None = None

    @property
    def edit(self) -> Editor:
        """The editor, which makes edits of the text."""
        return self.file.edit

    @property
    def value(self) -> str:
        """The value of the attribute that the finding is about, or the text of the element."""
        return self.element.get(self.attribute, "") if self.attribute else (self.element.text or "")

    def set_value(self, value: str) -> tuple[TextEdit, ...]:
        """Write another value in the place of `value`."""
        if self.attribute:
            return (self.edit.set_attribute(self.element, self.attribute, value),)
        return self.edit.set_text(self.element, value)

    def read(self, element: XmlElement, name: str) -> str:
        """Return the value of an element, which is an attribute in URDF and its text in SDF."""
        return (element.get(name) if self.file.format == "urdf" else element.text) or ""

    def write(self, element: XmlElement, name: str, value: str) -> tuple[TextEdit, ...]:
        """Write the value of an element, which is an attribute in URDF and its text in SDF."""
        if self.file.format == "urdf":
            return (self.edit.set_attribute(element, name, value),)
        return self.edit.set_text(element, value)

    def part(self, where: Location) -> XmlElement | None:
        """Return the element that another location leads to."""
        return self.file.find(where)


Fixer = Callable[[FindingSite], Fix | None]
"""Makes the fix of a finding; None where there is none."""
Fixers = Mapping[str, Fixer]
"""Fixers by the names of their rules."""
TextFixer = Callable[[Diagnostic, FixableFile], Fix | None]
"""Makes the fix of a finding about text that is not well-formed, or about lines instead of an element."""
TextFixers = Mapping[str, TextFixer]


def safe(title: str, *edits: TextEdit) -> Fix:
    """Make a fix after which all readers read the same robot as before, or the only one that the file can mean."""
    return Fix(title, edits, Safety.SAFE)


def revealing(title: str, *edits: TextEdit) -> Fix:
    """Make a safe fix that writes what stands in the file already, so that readers find it."""
    return Fix(title, edits, Safety.SAFE, keeps=False)


def unsafe(title: str, *edits: TextEdit) -> Fix:
    """Make a fix that may change the robot, or is a guess."""
    return Fix(title, edits, Safety.UNSAFE)


def careful(title: str, *edits: TextEdit) -> Fix:
    """Make an unsafe fix that is not made where another robot comes of it."""
    return Fix(title, edits, Safety.UNSAFE, keeps=True)


def display(title: str, *edits: TextEdit) -> Fix:
    """Make a fix in which the user has to fill in something."""
    return Fix(title, edits, Safety.DISPLAY)


def touches_expressions(fix: Fix, text: str) -> bool:
    """Whether a fix changes an expression of xacro or of a template."""
    return any(_EXPRESSION.search(edit.span.of(text)) for edit in fix.edits)
