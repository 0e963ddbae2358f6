"""Policy of a project: rules that it allows, and rules that it treats as errors."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.rule import Severity


@dataclass(frozen=True, slots=True)
class Policy:
    """Findings of `allow` are left out, unless they are errors: those stay. Findings of `deny` are errors."""

    allow: frozenset[str] = frozenset()
    deny: frozenset[str] = frozenset()

    def apply(self, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """The findings as the project wants to see them."""
        return tuple(
            self._with_severity(each) for each in diagnostics if each.is_error or each.rule.name not in self.allow
        )

    def _with_severity(self, diagnostic: Diagnostic) -> Diagnostic:
        """Return a finding as an error if its rule is denied."""
        return replace(diagnostic, severity=Severity.ERROR) if diagnostic.rule.name in self.deny else diagnostic
