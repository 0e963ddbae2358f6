"""Collects the differences of two robots, and decides on their severity."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from twinform.compiler.compare.compared_robot import Leaf
from twinform.compiler.compare.compared_values import Delta, Value, gaps, show
from twinform.compiler.compare.comparison import Difference, DifferenceSeverity, Side
from twinform.diagnostics import NOWHERE, LineOrigins, Location, Source
from twinform.ir import Format
from twinform.ir.transform import Transform

Places = tuple[Source | None, Source | None]
"""Where each of the files has what is compared."""
UNKNOWN: Places = (None, None)


@dataclass(frozen=True, slots=True)
class Base:
    """The frame that a value is seen from, in each of the robots."""

    a: Transform = field(default_factory=Transform)
    b: Transform = field(default_factory=Transform)


@dataclass(frozen=True, slots=True)
class ComparedSubject:
    """What a finding is about."""

    group: str
    name: str

    def __str__(self) -> str:
        return f"{self.group} {self.name!r}" if self.name else f"the {self.group}"


@dataclass(frozen=True, slots=True)
class Terms:
    """What is the same for the whole comparison: the names and formats of the files, and the tolerance.

    `origins` tell where lines of expanded texts were written, by the names of the files.
    """

    a: str
    b: str
    format_a: Format
    format_b: Format
    tolerance: float
    origins: Mapping[str, LineOrigins] = field(default_factory=dict[str, LineOrigins])

    def place(self, source: Source | None) -> Location:
        """Where somebody has written what was read there."""
        if source is None:
            return NOWHERE
        origins = self.origins.get(source.file)
        place = origins.place(source.line) if origins else None
        return place._replace(path=source.path) if place else source.location

    def differs(self, gap: Delta) -> bool:
        """Whether it is more than rounding."""
        return gap.exceeds(self.tolerance)

    def worst(self, a: Value, b: Value, base: Base | None = None) -> list[Delta]:
        """The gaps between two values that are more than rounding."""
        if a == b and (base is None or base.a == base.b):
            return []
        if base is not None:
            a, b = a.seen_from(base.a), b.seen_from(base.b)
        return [gap for gap in gaps(a, b) if self.differs(gap)]


@dataclass(slots=True)
class ComparisonFindings:
    """What was found so far."""

    terms: Terms
    model: str = ""
    items: list[Difference] = field(default_factory=list[Difference])

    def values(
        self,
        subject: ComparedSubject,
        aspect: str,
        a: Value,
        b: Value,
        places: Places,
        base: Base | None = None,
    ) -> None:
        """Add the differences between two values, if there are any."""
        self.gaps(subject, aspect, self.terms.worst(a, b, base), places)

    def gaps(
        self,
        subject: ComparedSubject,
        aspect: str,
        found: Iterable[Delta],
        places: Places,
        severity: DifferenceSeverity = DifferenceSeverity.DIFFERENCE,
        message: str = "",
    ) -> None:
        """Add a difference for each of the gaps."""
        for gap in found:
            path = f"{aspect}/{gap.aspect}" if gap.aspect else aspect
            words = message or f"{path} of {subject} is {gap.a} in {self.terms.a}, and {gap.b} in {self.terms.b}"
            number = gap if gap.absolute != float("inf") or gap.unit else None
            self._add(severity, subject, path, words, self._sides((gap.a, gap.b), places), number)

    def note(self, subject: ComparedSubject, aspect: str, message: str, places: Places) -> None:
        """Add a note."""
        self._add(DifferenceSeverity.NOTE, subject, aspect, message, self._sides((None, None), places))

    def only_in_one(
        self,
        subject: ComparedSubject,
        aspect: str,
        what: str,
        where: Source | None,
        *,
        in_a: bool,
        only: Format | None = None,
        carried: bool = False,
    ) -> None:
        """Add what only one of the robots has; a note where the other's format has no element for it."""
        terms = self.terms
        here, other = (terms.a, terms.format_b) if in_a else (terms.b, terms.format_a)
        name = f"{aspect} of {subject}" if aspect else str(subject)
        message, severity = f"{name} is only in {here}", DifferenceSeverity.DIFFERENCE
        if only is not None and other is not only:
            message, severity = f"{name} is only in {here}: {other.upper()} cannot express it", DifferenceSeverity.NOTE
        if carried:
            message = f"{name} is only in {here}, where it travels unseen by other readers"
        sides = self._sides((what, None), (where, None)) if in_a else self._sides((None, what), (None, where))
        self._add(severity, subject, aspect, message, sides)

    def leaf(
        self,
        subject: ComparedSubject,
        aspect: str,
        pair: tuple[Leaf | None, Leaf | None],
        base: Base,
        places: Places,
    ) -> bool:
        """Add the differences between two values; gives whether there are any.

        One of them may not be written; `places` are where they could be.
        """
        before = len(self.items)
        a, b = pair
        if a is not None and b is not None:
            self.values(subject, aspect, a.value, b.value, (a.where, b.where), base)
        elif (one := a or b) is not None:
            self._half_written(subject, aspect, one, places, in_a=a is not None)
        return len(self.items) > before

    def _half_written(self, subject: ComparedSubject, aspect: str, one: Leaf, places: Places, *, in_a: bool) -> None:
        if one.default is None:
            what = show(one.value)
            self.only_in_one(subject, aspect, what, one.where, in_a=in_a, only=one.only, carried=one.carried)
        elif in_a:
            self.values(subject, aspect, one.value, one.default, (one.where, places[1]))
        else:
            self.values(subject, aspect, one.default, one.value, (places[0], one.where))

    def _sides(self, texts: tuple[str | None, str | None], places: Places) -> tuple[Side, Side]:
        return Side(texts[0], self.terms.place(places[0])), Side(texts[1], self.terms.place(places[1]))

    def _add(
        self,
        severity: DifferenceSeverity,
        subject: ComparedSubject,
        aspect: str,
        message: str,
        sides: tuple[Side, Side],
        gap: Delta | None = None,
    ) -> None:
        self.items.append(
            Difference(
                severity=severity,
                model=self.model,
                group=subject.group,
                name=subject.name,
                aspect=aspect,
                message=message,
                a=sides[0],
                b=sides[1],
                absolute=gap.absolute if gap else None,
                relative=gap.relative if gap else None,
                unit=gap.unit if gap else "",
            )
        )
