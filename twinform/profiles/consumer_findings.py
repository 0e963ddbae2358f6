"""Findings for consumers: what `check --for` reports, one for each thing, with all the consumers that mind it."""

from collections.abc import Iterable, Iterator
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
_PLURALS = {Effect.REFUSES: "refuse", Effect.DROPS: "drop", Effect.MISREADS: "misread", Effect.WARNS: "warn"}
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
    passes = dict.fromkeys(judgment.row.pipeline for _, judgment in minded if judgment.row.pipeline)
    advice = f"--passes '{','.join(passes)}'" if passes else finding.help
    message = f"{finding.message}; {'; '.join(_words(minded))}"
    return replace(finding, message=message, severity=max(worst, finding.severity), help=advice)


def _words(minded: _Minded) -> Iterator[str]:
    """`Drake 1.51.1 and urdfdom 3.0.1 refuse: links need names of their own`, the worst first."""
    who: dict[tuple[Effect, str], dict[str, None]] = {}
    for assessment, judgment in minded:
        key = (judgment.row.effect, judgment.row.about)
        who.setdefault(key, {})[assessment.profile.label] = None
    order = list(_SEVERITIES)
    for (effect, about), labels in sorted(who.items(), key=lambda item: order.index(item[0][0])):
        *others, last = labels
        verb = _PLURALS[effect] if others else effect
        yield f"{', '.join(others)} and {last} {verb}: {about}" if others else f"{last} {verb}: {about}"
