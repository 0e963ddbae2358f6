"""Findings for consumers: what `check --for` reports, one for each thing, with all the consumers that mind it."""

from collections.abc import Iterable
from dataclasses import replace

from twinform.diagnostics import Diagnostic, Severity
from twinform.profiles.assessment import Assessment, Judgment
from twinform.profiles.profile import Effect

_SEVERITIES = {
    Effect.REFUSES: Severity.ERROR,
    Effect.DROPS: Severity.WARNING,
    Effect.MISREADS: Severity.WARNING,
    Effect.WARNS: Severity.INFO,
}
_Minded = list[tuple[Assessment, Judgment]]


def findings(assessments: Iterable[Assessment]) -> tuple[Diagnostic, ...]:
    """One finding for each thing that consumers mind, as severe as the worst that any of them does with it."""
    minded: dict[int, _Minded] = {}
    for assessment in assessments:
        for judgment in assessment.judgments:
            minded.setdefault(id(judgment.finding), []).append((assessment, judgment))
    return tuple(_finding(each) for each in minded.values())


def _finding(minded: _Minded) -> Diagnostic:
    finding = minded[0][1].finding
    worst = max(_SEVERITIES[judgment.row.effect] for _, judgment in minded)
    words = dict.fromkeys(f"{one.profile.label} {its.row.effect}: {its.row.about}" for one, its in minded)
    passes = dict.fromkeys(judgment.row.pipeline for _, judgment in minded if judgment.row.pipeline)
    advice = f"--passes '{','.join(passes)}'" if passes else finding.help
    message = f"{finding.message}; {'; '.join(words)}"
    return replace(finding, message=message, severity=max(worst, finding.severity), help=advice)
