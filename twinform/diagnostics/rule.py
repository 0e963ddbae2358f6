"""What a rule is: a kind of finding, with its documentation."""

from dataclasses import dataclass, field
from enum import IntEnum

from twinform.diagnostics.fix import Safety


class Severity(IntEnum):
    """How bad a finding is; only an error stops a conversion."""

    INFO = 1
    WARNING = 2
    ERROR = 3

    def __str__(self) -> str:
        return self.name.lower()


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A kind of finding. Its name describes the thing found, reads well after "allow", and is never used again.

    `strict` is the severity under `--strict`; it is the plain one where it is not given. `fix` says how safe
    its fixes are at best, if there are any. What is `fatal` leaves nothing to go on with, and cannot be allowed.
    What is `unsound` is no tree: `check` may allow it, and nothing can be made of it.
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

    def severity_in(self, *, strict: bool) -> Severity:
        """The severity of a finding in this mode."""
        return self.strict if strict and self.strict is not None else self.severity
