"""The sink into which each stage of the compiler writes diagnostics, and the policy that a project has for them."""

from collections.abc import Callable, Iterable
from dataclasses import field, replace
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics.diagnostic import NOWHERE, Diagnostic, LineOrigins, Location, Rule, Severity
from twinform.diagnostics.ledger import Fate, LedgerEntry


class SideFile(NamedTuple):
    """A file that a pass made: its path below the output folder, and its text or bytes.

    Whoever writes the result writes it. It may be written over a file that begins with the same line or, where it has a
    `mark`, over one that has this among its first bytes; over any other file it is not.
    """

    path: str
    content: str | bytes
    mark: bytes | None = None

    @property
    def data(self) -> bytes:
        """What is written: a text in UTF-8."""
        return self.content if isinstance(self.content, bytes) else self.content.encode()

    def is_earlier(self, head: bytes) -> bool:
        """Tell whether an existing file with this beginning was written by us and may be replaced."""
        if self.mark is not None:
            return self.mark in head
        return head.partition(b"\n")[0].rstrip() == self.data.partition(b"\n")[0].rstrip()


HEAD = 2**12
"""So many bytes of a file are looked at for the question who wrote it."""


MOST = 1000  # a hostile file can hold a hundred thousand mistakes; nobody reads past the first thousand
LONGEST = 2000
"""The longest message, in characters: a URI in it may have ten million."""


@dataclass(slots=True)
class DiagnosticSink:
    """Collects diagnostics and ledger entries, in the order in which they are made.

    `file` completes the locations, which know only a line and a path. `origins` lead from the lines of expanded texts
    to where they were written. `has_errors` is whether anything here stops a conversion. `side_files` are the files
    that passes make to lie beside the result. What it `allows` is no finding, and kept apart as `allowed`.
    """

    file: str = ""
    strict: bool = False
    diagnostics: list[Diagnostic] = field(default_factory=list[Diagnostic])
    entries: list[LedgerEntry] = field(default_factory=list[LedgerEntry])
    left_out: int = 0
    has_errors: bool = False
    origins: dict[str, LineOrigins] = field(default_factory=dict[str, LineOrigins])
    side_files: list[SideFile] = field(default_factory=list[SideFile])
    allows: Callable[[Diagnostic], bool] | None = None
    allowed: list[Diagnostic] = field(default_factory=list[Diagnostic])

    def __post_init__(self) -> None:
        self.has_errors = any(diagnostic.is_error for diagnostic in self.diagnostics)

    def report(
        self,
        rule: Rule,
        message: str,
        location: Location = NOWHERE,
        *,
        found: str | None = None,
        expected: str | None = None,
        help: str | Callable[[], str | None] | None = None,
        related: tuple[Location, ...] = (),
        severity: Severity | None = None,
        refused: bool = False,
    ) -> None:
        """Add a diagnostic; without a given severity, the rule and the mode decide.

        Past the limit, only the first error is still kept. `help` may be a function that makes it, which is called for
        what is kept alone.
        """
        severity = severity or rule.severity_in(strict=self.strict)
        if self.allows is None and not self.takes(severity):
            self.left_out += 1
            return
        message, found = _shortened(message), _shortened(found) if found else found
        if help is not None and not isinstance(help, str):
            help = help()
        where = self._complete(location)
        diagnostic = self._traced(
            Diagnostic(rule, message, where, severity, found, expected, help, related, None, refused)
        )
        self._add(diagnostic)

    def takes(self, severity: Severity) -> bool:
        """Tell whether a finding with this severity is kept."""
        # An error beyond the limit still has to stop the conversion.
        return len(self.diagnostics) < MOST or (severity is Severity.ERROR and not self.has_errors)

    def has(self, rule: Rule, location: Location, least: Severity = Severity.INFO) -> bool:
        """Tell whether this rule was reported at this place with at least this severity."""
        where = self._place(location)
        return any(
            each.rule is rule and self._place(each.location) == where and each.severity >= least
            for each in self.diagnostics
        )

    def extend_new(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add the diagnostics whose rule was not reported at their place before."""
        if not (diagnostics := tuple(diagnostics)):
            return
        known = {(each.rule.name, self._place(each.location)) for each in self.diagnostics}
        self.extend(each for each in diagnostics if (each.rule.name, self._place(each.location)) not in known)

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics that another stage has made."""
        for diagnostic in diagnostics:
            self._add(self._traced(diagnostic))

    def take_out(self, allowed: Iterable[Diagnostic]) -> None:
        """Remove the findings that are allowed, and remember them as such."""
        self.allowed.extend(allowed)
        gone = {id(each) for each in self.allowed}
        self.diagnostics = [each for each in self.diagnostics if id(each) not in gone]
        self.has_errors = any(each.is_error for each in self.diagnostics)

    def account(self, fate: Fate, rule: Rule, message: str, location: Location = NOWHERE, weight: int = 1) -> None:
        """Add a ledger entry."""
        self.entries.append(LedgerEntry(fate, rule, message, self._origin(self._complete(location)), weight))

    def traced_entries(self) -> tuple[LedgerEntry, ...]:
        """Return all entries of the ledger, with the places where their parts were written."""
        if not self.origins:  # they were completed when they were added
            return tuple(self.entries)
        return tuple(replace(each, location=self._origin(each.location)) for each in self.entries)

    def _place(self, location: Location) -> tuple[str, str | int]:
        """Return the key of a place: its path, since the line may be that of the part or of the node around it."""
        where = self._origin(self._complete(location))
        return where.file, where.path or where.line

    def _add(self, diagnostic: Diagnostic) -> None:
        if self.allows and self.allows(diagnostic):
            self.allowed.append(diagnostic)
            return
        if not self.takes(diagnostic.severity):
            self.left_out += 1
            return
        self.diagnostics.append(diagnostic)
        self.has_errors = self.has_errors or diagnostic.is_error

    def _complete(self, location: Location) -> Location:
        return location if location.file else location._replace(file=self.file)

    def _traced(self, diagnostic: Diagnostic) -> Diagnostic:
        """Return the diagnostic with its place of origin first, and its place in the expanded text second."""
        if diagnostic.location.file not in self.origins:
            return diagnostic
        where = self._origin(diagnostic.location)
        related = (diagnostic.location, *map(self._origin, diagnostic.related))
        return replace(diagnostic, location=where, related=related)

    def _origin(self, location: Location) -> Location:
        """Return where a place in an expanded text was written; any other place unchanged."""
        origins = self.origins.get(location.file)
        place = origins.place(location.line) if origins else None
        return place._replace(path=location.path) if place else location


def _shortened(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST // 2]} ... {text[-LONGEST // 4 :]}"


WARNINGS = "warnings"
"""The name that stands in `deny` for all warnings."""


@dataclass(frozen=True, slots=True)
class Policy:
    """Findings of `allow` are left out, unless they are errors: those stay. Findings of `deny` are errors.

    `deny` may have `warnings` in the place of a rule: then no finding is a warning.
    """

    allow: frozenset[str] = frozenset()
    deny: frozenset[str] = frozenset()

    def apply(self, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """The findings as the project wants to see them."""
        return tuple(
            self._with_severity(each) for each in diagnostics if each.is_error or each.rule.name not in self.allow
        )

    def _with_severity(self, diagnostic: Diagnostic) -> Diagnostic:
        """Return a finding as an error if its rule is denied, or all warnings are."""
        is_denied = diagnostic.rule.name in self.deny
        is_denied |= diagnostic.severity is Severity.WARNING and WARNINGS in self.deny
        return replace(diagnostic, severity=Severity.ERROR) if is_denied else diagnostic
