"""Findings as values: `Rule`, `Location`, `Fix` and `Diagnostic`."""

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import field
from enum import IntEnum, StrEnum
from typing import NamedTuple, Self

from twinform.dataclass import dataclass


class Location(NamedTuple):
    """A place in a source file; every part may be unknown.

    `line` counts from 1, and 0 means unknown. `path` is an XPath that finds the element or attribute again, such as
    `/robot/joint[@name='hip']/limit/@lower`. The columns, and the end of the piece of text, which does not belong to it
    any more, are known only where somebody has asked for them (`compiler/input/finding_spans.py`).
    """

    file: str = ""
    line: int = 0
    path: str = ""
    column: int = 0
    end_line: int = 0
    end_column: int = 0

    def at(self, step: str) -> "Location":
        """Return the location one step further down the path, on the same line."""
        return Location(self.file, self.line, f"{self.path}/{step}")


NOWHERE = Location()


class Source(NamedTuple):
    """Where a part of a document was read, in a form that is cheap to keep: the path is made when it is asked for.

    `above` is the source of the node around it, `step` the element names from there, and `key` the name of the last
    one or its place among its like, where it needs one to be found.
    """

    file: str
    line: int
    above: "Source | None"
    step: str
    key: str | int | None = None

    @property
    def path(self) -> str:
        """An XPath from the root of the file."""
        steps: list[str] = []
        here: Source | None = self
        while here is not None:
            steps.append(here.last_step)
            here = here.above
        return "/" + "/".join(reversed(steps))

    @property
    def last_step(self) -> str:
        """The step from the node around it to this part."""
        if self.key is None:
            return self.step
        return f"{self.step}[{self.key}]" if isinstance(self.key, int) else f"{self.step}[@name='{self.key}']"

    @property
    def location(self) -> Location:
        """The `Location` of this place."""
        return Location(self.file, self.line, self.path)


@dataclass(frozen=True, slots=True)
class LineOrigins:
    """The file and line of origin for each line of an expanded text that starts an element."""

    lines: tuple[int, ...] = ()
    places: tuple[Location, ...] = ()

    @classmethod
    def of(cls, pairs: Iterable[tuple[int, Location]]) -> Self:
        """Collect lines and origins in any order; the first origin of a line counts."""
        first: dict[int, Location] = {}
        for line, place in pairs:
            first.setdefault(line, place)
        ordered = sorted(first.items())
        return cls(tuple(line for line, _ in ordered), tuple(place for _, place in ordered))

    def place(self, line: int) -> Location | None:
        """Return the origin of the element that starts on a line, or on the last line before it that starts one."""
        index = bisect_right(self.lines, line) - 1
        return self.places[index] if index >= 0 else None


class Span(NamedTuple):
    """A piece of text from `start` up to but not including `end`, in characters from 0."""

    start: int
    end: int

    def of(self, text: str) -> str:
        """The piece itself."""
        return text[self.start : self.end]


class TextEdit(NamedTuple):
    """An edit: the text at `span` becomes `new`; an empty span inserts.

    `file` is empty for the file that was read, and names another one that it includes.
    """

    span: Span
    new: str
    file: str = ""


class Safety(StrEnum):
    """How far a fix may change a robot: safe ones are made unasked, unsafe ones on request, displayed ones never."""

    SAFE = "safe"
    """The model means the same afterwards: what every reader takes it for is only written down."""
    UNSAFE = "unsafe"
    """The model may mean something else, or the fix is a guess."""
    DISPLAY = "display"
    """An idea: something in it has to be filled in."""


@dataclass(frozen=True, slots=True)
class Fix:
    """Edits of the text that fix a finding; `title` says what they do as a command to a person.

    A fix that `keeps` the robot is not made where another one comes of it. Others are meant to change what readers
    take a file for: guesses, and values that stand in the file where no reader looks. Safe fixes keep it unless they
    say otherwise, and no others do.
    """

    title: str
    edits: tuple[TextEdit, ...]
    safety: Safety = Safety.SAFE
    keeps: bool | None = None

    @property
    def keeps_robot(self) -> bool:
        """Whether the robot is meant to be the same afterwards."""
        return self.safety is Safety.SAFE if self.keeps is None else self.keeps


class Severity(IntEnum):
    """How bad a finding is; only an error stops a conversion."""

    INFO = 1
    WARNING = 2
    ERROR = 3

    def __str__(self) -> str:
        return self.name.lower()

    @property
    def word(self) -> str:
        """The word for a finding, as people and SARIF say it: error, warning, or note."""
        return "note" if self is Severity.INFO else str(self)


WORST_FIRST = (Severity.ERROR, Severity.WARNING, Severity.INFO)
"""All severities."""
GROUPS = (
    "structure",
    "references",
    "physics",
    "limits",
    "meshes",
    "plugins",
    "sensors",
    "control",
    "xacro",
    "portability",
    "style",
)
"""The groups of rules, each of which has one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A kind of finding. Its name describes the thing found, reads well after "allow", and is never used again.

    `strict` is the severity under `--strict`; it is the plain one where it is not given. `fix` says how safe
    its fixes are at best, if there are any. What is `fatal` leaves nothing to go on with, and
    what is `unsound` is no tree: `check` may allow both, and nothing can be made of them.
    The other fields are the rule's page, as `twinform explain` prints it; two rules are not told apart by it.
    """

    name: str
    severity: Severity
    finds: str = field(compare=False, repr=False)
    matters: str = field(compare=False, repr=False)
    example: str = field(compare=False, repr=False)
    better: str = field(compare=False, repr=False)
    references: str = field(default="", compare=False, repr=False)
    strict: Severity | None = None
    fix: Safety | None = None
    fatal: bool = False
    unsound: bool = False
    group: str = field(default="structure", compare=False, repr=False)

    def severity_in(self, *, strict: bool) -> Severity:
        """The severity of a finding in this mode."""
        return self.strict if strict and self.strict is not None else self.severity


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One problem in one place. The message stands alone; `found` and `expected` repeat its two halves for programs.

    Who asks for it puts in the `fix` (`compiler/fixing/`); no stage that finds something makes one. A finding is
    `refused` where a reader that the file is for refuses it for that, or no robot can be so: `check` makes an error of
    it, and what can still be converted is.
    """

    rule: Rule
    message: str
    location: Location = NOWHERE
    severity: Severity = Severity.INFO
    found: str | None = None
    expected: str | None = None
    help: str | None = None
    related: tuple[Location, ...] = ()
    fix: Fix | None = None
    refused: bool = False

    @property
    def is_error(self) -> bool:
        """Whether it stops a conversion."""
        return self.severity is Severity.ERROR
