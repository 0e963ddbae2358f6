"""The result of a comparison of two robots."""

from collections.abc import Iterable, Mapping
from dataclasses import field
from enum import StrEnum

from twinform.compiler.compare.compared_robot import Leaf
from twinform.compiler.compare.compared_values import Delta, Value, gaps, show
from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, LineOrigins, Location, Source
from twinform.ir import Format
from twinform.ir.transform import Transform

TOLERANCE = 1e-9
"""The share of a value, or of a meter or radian where it is smaller than that, up to which a difference is rounding."""


class DifferenceSeverity(StrEnum):
    """How much a difference counts.

    A `difference` makes two robots different to every reader. A `carried` one only does so for some: it is in a carrier
    or in `<gazebo>`, which other readers skip. A `note` is about one thing that is written in two ways.
    """

    DIFFERENCE = "difference"
    CARRIED = "carried"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Side:
    """The value in one file, as text in SI units, or None where it has none; and where."""

    text: str | None = None
    location: Location = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One thing in which two robots differ, or in which they are described in different ways.

    `model` names the robot where several are compared, and is empty otherwise. `group` is `world`, `file`, `model`,
    `link`, `joint`, `frame` or `kinematics`, and `name` that of the world, link, joint or frame; `aspect` is the path
    to the value from there.
    `reader` is set for carried differences: the one reader, `gazebo` or `twinform`, that sees the difference or does
    not see it. `absolute` is the distance of the values in `unit`, and `relative` its share of the larger value; both
    are None where the values are not numbers.
    """

    severity: DifferenceSeverity
    model: str = ""
    group: str
    name: str
    aspect: str
    message: str
    a: Side = Side()
    b: Side = Side()
    absolute: float | None = None
    relative: float | None = None
    unit: str = ""
    reader: str = ""


@dataclass(frozen=True, slots=True)
class ComparisonOptions:
    """How robots are compared: which share of a value counts as rounding, and whether carriers count as written.

    Without `carriers`, differences that only carriers make are reported as `carried`.
    """

    tolerance: float = TOLERANCE
    carriers: bool = False


USUAL = ComparisonOptions()


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two files and how the robots in them differ, in the order worlds, model, links, joints, frames, kinematics."""

    a: str
    b: str
    tolerance: float
    items: tuple[Difference, ...] = ()

    @property
    def same(self) -> bool:
        """Whether both files describe the same robot, to every reader."""
        return not self.counted

    @property
    def counted(self) -> tuple[Difference, ...]:
        """The items that make the robots different to every reader or to some."""
        return (*self.differences, *self.carried)

    @property
    def differences(self) -> tuple[Difference, ...]:
        """The items that make the robots different to every reader."""
        return self._with_severity(DifferenceSeverity.DIFFERENCE)

    @property
    def carried(self) -> tuple[Difference, ...]:
        """The items that make the robots different to some readers, because they are in a carrier or `<gazebo>`."""
        return self._with_severity(DifferenceSeverity.CARRIED)

    @property
    def notes(self) -> tuple[Difference, ...]:
        """The items that are written in two ways and mean the same."""
        return self._with_severity(DifferenceSeverity.NOTE)

    def _with_severity(self, severity: DifferenceSeverity) -> tuple[Difference, ...]:
        return tuple(item for item in self.items if item.severity is severity)


Places = tuple[Source | None, Source | None]
"""The places of the compared parts in the two files."""
UNKNOWN: Places = (None, None)


@dataclass(frozen=True, slots=True)
class Base:
    """The frame in which a value is compared, for each of the robots."""

    a: Transform = field(default_factory=Transform)
    b: Transform = field(default_factory=Transform)


@dataclass(frozen=True, slots=True)
class ComparedSubject:
    """The part of a robot that a difference is about."""

    group: str
    name: str

    def __str__(self) -> str:
        return f"{self.group} {self.name!r}" if self.name else f"the {self.group}"


@dataclass(frozen=True, slots=True)
class Terms:
    """The names and formats of the compared files, and the tolerance.

    `origins` tell where lines of expanded texts were written, by the names of the files. What only MJCF says is
    compared where both files are `of_mjcf`: elsewhere it travels along, and what was edited beside it wins.
    """

    a: str
    b: str
    format_a: Format
    format_b: Format
    tolerance: float
    origins: Mapping[str, LineOrigins] = field(default_factory=dict[str, LineOrigins])
    of_mjcf: bool = False

    def place(self, source: Source | None) -> Location:
        """Return where the author of a file has written what was read at a place."""
        if source is None:
            return NOWHERE
        origins = self.origins.get(source.file)
        place = origins.place(source.line) if origins else None
        return place._replace(path=source.path) if place else source.location

    def differs(self, gap: Delta) -> bool:
        """Whether a gap is more than rounding."""
        return gap.exceeds(self.tolerance)

    def worst(self, a: Value, b: Value, base: Base | None = None) -> list[Delta]:
        """Return the gaps between two values that are more than rounding."""
        if a == b and (base is None or base.a == base.b):
            return []
        if base is not None:
            a, b = a.seen_from(base.a), b.seen_from(base.b)
        return [gap for gap in gaps(a, b) if self.differs(gap)]


@dataclass(slots=True)
class ComparisonFindings:
    """The differences found so far; `model` is the name of the robot where several are compared."""

    terms: Terms
    model: str = ""
    items: list[Difference] = field(default_factory=list[Difference])

    def compare_values(
        self,
        subject: ComparedSubject,
        aspect: str,
        a: Value,
        b: Value,
        places: Places,
        base: Base | None = None,
    ) -> None:
        """Compare two values, and add their differences."""
        self.add_gaps(subject, aspect, self.terms.worst(a, b, base), places)

    def add_gaps(
        self,
        subject: ComparedSubject,
        aspect: str,
        found: Iterable[Delta],
        places: Places,
        severity: DifferenceSeverity = DifferenceSeverity.DIFFERENCE,
        message: str = "",
    ) -> None:
        """Add a difference for each gap."""
        for gap in found:
            path = f"{aspect}/{gap.aspect}" if gap.aspect else aspect
            words = message or f"{path} of {subject} is {gap.a} in {self.terms.a}, and {gap.b} in {self.terms.b}"
            number = gap if gap.absolute != float("inf") or gap.unit else None
            self._add(severity, subject, path, words, self._sides((gap.a, gap.b), places), number)

    def add_note(self, subject: ComparedSubject, aspect: str, message: str, places: Places) -> None:
        """Add a note."""
        self._add(DifferenceSeverity.NOTE, subject, aspect, message, self._sides((None, None), places))

    def add_one_sided(
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
        """Add a part that only one of the robots has; it is a note where the other's format has no element for it."""
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

    def compare_leaf(
        self,
        subject: ComparedSubject,
        aspect: str,
        pair: tuple[Leaf | None, Leaf | None],
        base: Base,
        places: Places,
    ) -> bool:
        """Compare two leaves, one of which may be missing, and return whether they differ.

        `places` are the places of the parts around them.
        """
        before = len(self.items)
        a, b = pair
        if (one := a or b) is not None and one.only is Format.MJCF and not self.terms.of_mjcf:
            return False
        if a is not None and b is not None:
            self.compare_values(subject, aspect, a.value, b.value, (a.where, b.where), base)
        elif (one := a or b) is not None:
            self._compare_with_default(subject, aspect, one, places, in_a=a is not None)
        return len(self.items) > before

    def _compare_with_default(
        self, subject: ComparedSubject, aspect: str, one: Leaf, places: Places, *, in_a: bool
    ) -> None:
        if one.default is None:
            what, only = show(one.value), None if one.only is Format.MJCF else one.only  # which both files are
            self.add_one_sided(subject, aspect, what, one.where, in_a=in_a, only=only, carried=one.carried)
        elif in_a:
            self.compare_values(subject, aspect, one.value, one.default, (one.where, places[1]))
        else:
            self.compare_values(subject, aspect, one.default, one.value, (places[0], one.where))

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
