"""What a stage of the compiler writes its findings into."""

from dataclasses import dataclass, field

from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.ledger import Entry, Fate
from twinform.diagnostics.location import NOWHERE, Location
from twinform.diagnostics.rule import Rule

MOST = 1000  # a hostile file can hold a hundred thousand mistakes; nobody reads past the first thousand


@dataclass(slots=True)
class Notes:
    """Collects diagnostics and ledger entries, in the order in which they are made.

    `file` completes the locations, which know only a line and a path.
    """

    file: str = ""
    strict: bool = False
    diagnostics: list[Diagnostic] = field(default_factory=list[Diagnostic])
    entries: list[Entry] = field(default_factory=list[Entry])
    left_out: int = 0

    def report(
        self,
        rule: Rule,
        message: str,
        location: Location = NOWHERE,
        *,
        found: str | None = None,
        expected: str | None = None,
        help: str | None = None,  # noqa: A002 - the word that the JSON report uses
        related: tuple[Location, ...] = (),
    ) -> None:
        """Add a diagnostic; its severity follows from the rule and the mode. Errors are kept past the limit."""
        severity = rule.severity_in(strict=self.strict)
        diagnostic = Diagnostic(rule, message, self._complete(location), severity, found, expected, help, related)
        if len(self.diagnostics) < MOST or (diagnostic.is_error and not self.has_errors):
            self.diagnostics.append(diagnostic)
        else:
            self.left_out += 1

    def account(self, fate: Fate, rule: Rule, message: str, location: Location = NOWHERE, weight: int = 1) -> None:
        """Add a ledger entry."""
        self.entries.append(Entry(fate, rule, message, self._complete(location), weight))

    @property
    def has_errors(self) -> bool:
        """Whether anything here stops a conversion."""
        return any(diagnostic.is_error for diagnostic in self.diagnostics)

    def _complete(self, location: Location) -> Location:
        return location if location.file else location._replace(file=self.file)
