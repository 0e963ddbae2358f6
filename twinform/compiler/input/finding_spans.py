"""Columns of findings: the piece of the text that a location means, from its line and its path."""

from dataclasses import dataclass, field

from twinform.compiler.input.finding_lines import PartFinder
from twinform.compiler.input.loading import read_tree_again
from twinform.compiler.input.parsing import UnreadableError
from twinform.diagnostics import Location, Span
from twinform.schemas import XmlElement
from twinform.text import ElementSpan, Lines, SourceText, UndecodableError, UnplacedError, spans


@dataclass(frozen=True, slots=True)
class FindingSpans:
    """Where the findings about one file stand in its text."""

    text: str
    lines: Lines
    parts: PartFinder
    places: dict[XmlElement, ElementSpan] = field(repr=False)

    @classmethod
    def of(cls, data: bytes) -> "FindingSpans | None":
        """Those of a file; None for one that is not well-formed or no text."""
        try:
            root = read_tree_again(data)
            text = SourceText.of(data).text
            places = dict(zip(root.iter("*"), spans(text).walk(), strict=True))
        except (UnreadableError, UndecodableError, UnplacedError):
            return None
        return cls(text, Lines(text), PartFinder(root), places)

    def span(self, where: Location) -> Span | None:
        """The attribute with its value, or the start tag, that a location leads to; None where it leads to none.

        An attribute that is not written is missed in the start tag.
        """
        element = self.parts.find(where)
        if element is None:
            return None
        place = self.places[element]
        attribute = place.attributes.get(where.path.rpartition("/@")[2]) if "/@" in where.path else None
        return attribute.whole if attribute else place.start_tag
