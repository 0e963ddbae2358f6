"""`Diagnostic`: a finding as a value."""

from dataclasses import dataclass

from twinform.diagnostics.fix import Fix
from twinform.diagnostics.location import NOWHERE, Location
from twinform.diagnostics.rule import Rule, Severity


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One problem in one place. The message stands alone; `found` and `expected` repeat its two halves for programs.

    Who asks for it puts in the `fix` (`compiler/fixing/`); no stage that finds something makes one.
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

    @property
    def is_error(self) -> bool:
        """Whether it stops a conversion."""
        return self.severity is Severity.ERROR
