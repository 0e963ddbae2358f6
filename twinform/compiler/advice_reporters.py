"""Advice as text and as JSON; reporters only format."""

import json as jsonlib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from itertools import chain

from twinform.compiler.advising import Advice, ConsumerReading
from twinform.diagnostics.reporters import printable
from twinform.passes import Pipeline
from twinform.profiles import Assessment, Effect, Judgment
from twinform.profiles.remedies import changes_physics, remedies

_NOTHING = "-"


def text(advice: Advice) -> str:
    """Format the choice with its reasons, a row for each consumer, and the first thing that each of them minds."""
    return "\n".join(chain(_choice_lines(advice), [""], _table_lines(advice), _details(advice))) + "\n"


def json(advice: Advice) -> str:
    """Format advice as `{"path", "format", "version", "model", "keep", "reasons", "unsaid", "consumers"}`.

    `unsaid` are the parts that the other format does not express: `{"rule", "fate", "number", "example"}`. A consumer
    is `{"name", "title", "version", "tested", "forms", "passes"}`; its `forms` are what it makes of `urdf`, `sdf`
    and `mjcf`, as far as it reads them: `{"verdict", "findings": [{"rule", "effect", "about", "line", "path",
    "message"}]}`.
    """
    whole = {
        "path": advice.path,
        "format": str(advice.format),
        "version": advice.version,
        "model": advice.name,
        "keep": str(advice.choice.format),
        "reasons": list(advice.choice.reasons),
        "unsaid": [each._asdict() for each in advice.other.losses()],
        "consumers": [_consumer_fields(each) for each in advice.consumers],
    }
    return jsonlib.dumps(whole, indent=2) + "\n"


REPORTERS: Mapping[str, Callable[[Advice], str]] = {"text": text, "json": json}


def _choice_lines(advice: Advice) -> Iterator[str]:
    version = f" {advice.version}" if advice.version else ""
    yield printable(f"{advice.path}: {advice.format.upper()}{version}, {advice.name!r}")
    kept = advice.choice.format
    others = [each.upper() for each, form in advice.rivals.items() if each is not kept and form.exists]
    change = "Keep it as" if kept is advice.format else "Make it"
    derived = f", and convert it to {' and '.join(others)} for those who read that" if others else ""
    yield f"{change} {kept.upper()}{derived}:"
    yield from (f"  * {printable(reason)}" for reason in advice.choice.reasons)


def _table_lines(advice: Advice) -> Iterator[str]:
    head = ("consumer", *(f"as {each.upper()}" for each in advice.formats), "passes that help")
    rows = [head, *(_table_row(each, advice) for each in advice.consumers)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()


def _table_row(reading: ConsumerReading, advice: Advice) -> tuple[str, ...]:
    cells = (_verdict_cell(reading.forms.get(format_)) for format_ in advice.formats)
    return (_label(reading), *cells, _passes_that_help(reading.best(advice.choice.format)))


def _label(reading: ConsumerReading) -> str:
    return reading.profile.label if reading.profile.tested else f"{reading.profile.label} (not tested)"


def _verdict_cell(assessment: Assessment | None) -> str:
    """Sum up an assessment, such as `refuses (2)` or `drops 1, misreads 3`; a dash where the format is not read."""
    if assessment is None:
        return _NOTHING
    count = Counter(each.row.effect for each in assessment.judgments)
    if count[Effect.REFUSES]:
        return f"refuses ({count[Effect.REFUSES]})"
    lost = [f"{effect} {count[effect]}" for effect in (Effect.DROPS, Effect.MISREADS) if count[effect]]
    return ", ".join(lost) or ("takes it, with warnings" if count[Effect.WARNS] else "takes it")


def _passes_that_help(assessment: Assessment | None) -> str:
    """List the passes that help, in their order, with a star for those that change the physics."""
    steps = remedies([assessment]) if assessment else ()
    return ", ".join(dict.fromkeys(f"{step.name}{'*' if changes_physics(step) else ''}" for step in steps))


def _details(advice: Advice) -> Iterator[str]:
    """Yield the first thing that each consumer minds in the form that suits it best, and in one that it refuses."""
    told = [line for reading in advice.consumers for line in _details_of(reading, advice)]
    if told:
        yield ""
    yield from told
    if any("*" in _passes_that_help(each.best(advice.choice.format)) for each in advice.consumers):
        yield ""
        yield "* changes the physics; the ledger of the conversion says how"


def _details_of(reading: ConsumerReading, advice: Advice) -> Iterator[str]:
    best = reading.best(advice.choice.format)
    for format_, assessment in reading.forms.items():
        effects = (Effect.REFUSES, Effect.DROPS, Effect.MISREADS) if assessment is best else (Effect.REFUSES,)
        judgments = [each for effect in effects for each in assessment.by(effect)]
        if judgments:
            first = judgments[0]
            others = len(assessment.by(first.row.effect)) - 1
            more = f", and {others} more" if others else ""
            what = f" the {format_.upper()}" if len(reading.forms) > 1 else ""
            place = f"line {first.finding.location.line}: " if first.finding.location.line else ""
            yield printable(f"{reading.profile.label} {first.row.effect}{what}: {place}{first.finding.message}{more}")


def _consumer_fields(reading: ConsumerReading) -> dict[str, object]:
    profile = reading.profile
    return {
        "name": profile.name,
        "title": profile.title,
        "version": profile.version,
        "tested": profile.tested,
        "forms": {str(format_): _form_fields(each) for format_, each in reading.forms.items()},
        "passes": [str(Pipeline((step,))) for step in remedies(reading.forms.values())],
    }


def _form_fields(assessment: Assessment) -> dict[str, object]:
    return {"verdict": str(assessment.verdict), "findings": [_judgment_fields(each) for each in assessment.judgments]}


def _judgment_fields(judgment: Judgment) -> dict[str, object]:
    return {
        "rule": judgment.row.rule,
        "effect": str(judgment.row.effect),
        "about": judgment.row.about,
        "line": judgment.finding.location.line,
        "path": judgment.finding.location.path,
        "message": judgment.finding.message,
    }
