"""Compares two normal forms: what is in one and not in the other."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum

from twinform.compiler.compare.compared_values import show
from twinform.compiler.compare.comparison import Side
from twinform.compiler.normal_form.part import TEXT, Key, NormalPart, text_of
from twinform.compiler.normal_form.value_meanings import same
from twinform.diagnostics import Location
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.schemas import XmlElement, path_of

_LONGEST = 100
_ITSELF = "."
"""The step from an element to what is no value of its own."""


class DifferenceKind(StrEnum):
    """In what way two normal forms differ at a place."""

    MISSING = "missing"
    CHANGED = "changed"
    ADDED = "added"
    LEFT_OVER = "left over"
    """A carrier or an annotation that has come along."""
    ORDER = "order"


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """A value that the source has and the file from the round trip has not, or the other way round."""

    kind: DifferenceKind
    source: Side
    back: Side

    @property
    def location(self) -> Location:
        """Where it is: in the source, or where that has nothing of the kind, in the other."""
        return self.source.location if self.source.text is not None else self.back.location

    @property
    def message(self) -> str:
        """The discrepancy as text."""
        where = self.location
        place = f"{where.file}:{where.line}: {where.path}"
        if self.kind is DifferenceKind.MISSING:
            return f"{place}: {self.source.text} is not back"
        if self.kind in {DifferenceKind.ADDED, DifferenceKind.LEFT_OVER}:
            return f"{place}: {self.back.text} was not in the source"
        return f"{place}: {self.source.text} became {self.back.text}"


@dataclass(slots=True)
class Comparing:
    """A comparison of two files of these names."""

    source: str
    back: str
    _places: dict[XmlElement, int] = field(default_factory=dict[XmlElement, int])

    def files(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """The discrepancies of two whole files."""
        if source.element.tag == back.element.tag:
            yield from self.parts(source, back)
        else:
            yield Discrepancy(DifferenceKind.CHANGED, self._in_source(source), self._in_back(back))

    def parts(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """The discrepancies of two parts of one key."""
        yield from self._values(source, back)
        pairs = _paired(source, back)
        found = frozenset(pairs.values())
        for key, child in source.children.items():
            if key in pairs:
                yield from self.parts(child, back.children[pairs[key]])
            else:
                yield Discrepancy(DifferenceKind.MISSING, self._in_source(child), Side())
        for key, child in back.children.items():
            if key not in found:
                yield Discrepancy(_kind_of_new(key.tag), Side(), self._in_back(child))
        yield from self._orders(source, back)

    def _values(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        for step, value in source.values.items():
            other = back.values.get(step)
            if other is None:
                yield Discrepancy(DifferenceKind.MISSING, self._in_source(source, step), Side())
            elif not same(value, other):
                yield Discrepancy(DifferenceKind.CHANGED, self._in_source(source, step), self._in_back(back, step))
        for step in back.values:
            if step not in source.values:
                yield Discrepancy(_kind_of_new(step.removeprefix("@")), Side(), self._in_back(back, step))

    def _orders(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """The first place where the order is another one, where order counts."""
        if not (source.ordered or back.ordered):
            return
        mine = [key for key in source.children if key in back.children]
        theirs = [key for key in back.children if key in source.children]
        at = next((n for n, (one, other) in enumerate(zip(mine, theirs, strict=True)) if one != other), None)
        if at is not None:
            one, other = source.children[mine[at]], back.children[theirs[at]]
            yield Discrepancy(DifferenceKind.ORDER, self._in_source(one), self._in_back(other))

    def _in_source(self, part: NormalPart, step: str = _ITSELF) -> Side:
        return self._side_of(self.source, part, step)

    def _in_back(self, part: NormalPart, step: str = _ITSELF) -> Side:
        return self._side_of(self.back, part, step)

    def _side_of(self, file: str, part: NormalPart, step: str) -> Side:
        where = Location(file, part.element.sourceline or 0, path_of(part.element, self._places))
        if step.startswith("@"):
            text = part.element.get(step[1:])
            return Side(show(part.values[step]) if text is None else repr(_short(text)), where.at(step))
        return Side(repr(_short(text_of(part.element))) if step == TEXT else _spelled(part.element), where)


def _paired(source: NormalPart, back: NormalPart) -> dict[Key, Key]:
    """The children that are the same ones: of one key, or, where one of them has lost or got a name, the next ones."""
    pairs = {key: key for key in source.children if key in back.children}
    left: dict[str, list[Key]] = {}
    for key in reversed(back.children):
        if key not in pairs:
            left.setdefault(key.tag, []).append(key)
    for key in source.children:
        candidates = left.get(key.tag) if key not in pairs else None
        # A name that a conversion synthesized, and did not take back, is a discrepancy of its own:
        # found at the part, and not as one part that is missing and another that is new.
        if candidates and bool(candidates[-1].name) != bool(key.name):
            pairs[key] = candidates.pop()
    return pairs


def _kind_of_new(name: str) -> DifferenceKind:
    return DifferenceKind.LEFT_OVER if name.startswith(f"{{{NAMESPACE}}}") else DifferenceKind.ADDED


def _spelled(element: XmlElement) -> str:
    """The beginning of an element as XML."""
    tag = str(element.tag).rpartition("}")[2]
    attributes = "".join(f' {str(name).rpartition("}")[2]}="{value}"' for name, value in element.items())
    inside = " ".join((element.text or "").split())
    return _short(f"<{tag}{attributes}>{inside}" if inside or len(element) else f"<{tag}{attributes}/>")


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
