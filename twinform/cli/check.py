"""`twinform check`."""

from collections import Counter
from dataclasses import replace
from typing import Unpack

import click

from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.findings import notes_option, show
from twinform.cli.inputs import HowToRead, how_to_read, inputs, reading_options
from twinform.cli.ordering import pipeline_option
from twinform.cli.policy import policy_of, policy_options
from twinform.compiler import Checked, LookingError, Reading, expand, inspect, read
from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import REPORTERS, Findings
from twinform.passes import PassError, Pipeline

_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


@click.command("check")
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print findings.")
@notes_option
@policy_options
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    help="Passes that only look, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    notes: bool,
    allow: tuple[str, ...],
    deny: tuple[str, ...],
    check_passes: Pipeline,
    expand_includes: bool,
    **how: Unpack[HowToRead],
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code: 0
    without errors, 1 with errors, 2 where a file could not be read.
    """
    sources, arguments = inputs(words)
    policy, reading = policy_of(ctx, allow, deny), how_to_read(arguments, how)
    checked = [read(each.content, reading, name=each.name) for each in sources]
    checked = [expand(each, reading) for each in checked] if expand_includes else checked
    checked = [_inspected(each, reading, check_passes) for each in checked]
    checked, seen = [replace(each, diagnostics=policy.apply(each.diagnostics)) for each in checked], checked
    allowed = sum(len(each.diagnostics) for each in seen) - sum(len(each.diagnostics) for each in checked)
    findings = [Findings(each.path, each.diagnostics) for each in checked]
    if style == "text":
        for each in findings:
            show(each, notes=notes, on_stderr=False)
    else:
        click.echo(REPORTERS[style](findings), nl=False)
    click.echo(_summary(checked) + (f"; {allowed} allowed" if allowed else ""), err=True)
    ctx.exit(_exit_code(checked))


def _inspected(checked: Checked, reading: Reading, passes: Pipeline) -> Checked:
    try:
        return inspect(checked, reading, passes)
    except LookingError as error:
        raise click.UsageError(str(error)) from error
    except PassError as error:
        raise Unusable(str(error)) from error


def _exit_code(checked: list[Checked]) -> int:
    if any(each.unreadable for each in checked):
        return UNUSABLE
    return 0 if all(each.accepted for each in checked) else FINDINGS


def _summary(checked: list[Checked]) -> str:
    counts = Counter(diagnostic.severity for each in checked for diagnostic in each.diagnostics)
    found = ", ".join(_count(counts[severity], word) for severity, word in _WORDS.items())
    unreadable = sum(each.unreadable for each in checked)
    return f"{_count(len(checked), 'file')}: {found}{f'; {unreadable} could not be read' if unreadable else ''}"


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
