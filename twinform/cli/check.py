"""`twinform check`."""

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

import click
import pydantic  # noqa: F401 # pyright: ignore[reportUnusedImport] - decisions: near the top of the stack

from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.findings import notes_option, show
from twinform.cli.inputs import InputOptions, inputs, load_options_of, reading_options
from twinform.cli.pipeline_option import pipeline_option
from twinform.cli.policy import policy_of, policy_options
from twinform.compiler import LoadOptions, LoadResult, ReadOnlyPassError, inspect, read
from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import REPORTERS, Findings
from twinform.passes import PassError

if TYPE_CHECKING:
    from twinform.passes import Pipeline

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
    help="Read-only passes, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@click.option("--fix", is_flag=True, help="Mend what can be mended without another robot coming of it, in the files.")
@click.option("--unsafe-fixes", is_flag=True, help="Mend what is a guess too, or may make another robot of a file.")
@click.option("--diff", is_flag=True, help="Print what --fix would change, and write nothing; exit code 1 if anything.")
@click.option("--fix-only", is_flag=True, help="Mend, and report nothing of what is left.")
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
    check_passes: "Pipeline | None",
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    fix_only: bool,
    expand_includes: bool,
    **input_options: Unpack[InputOptions],
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code: 0
    without errors, 1 with errors, 2 where a file could not be read.
    """
    sources, arguments = inputs(words)
    policy, load_options = policy_of(ctx, allow, deny), load_options_of(arguments, input_options)

    def look(content: str | bytes, name: str) -> LoadResult:
        found = read(content, load_options, name=name)
        if expand_includes:
            from twinform.compiler import expand  # noqa: PLC0415 - few runs read other files

            found = expand(found, load_options)
        return _inspected(found, load_options, check_passes)

    if fix or diff or fix_only:
        from twinform.cli.fixing import Fixing, run_fixes  # noqa: PLC0415 - most runs only look

        on_stderr = not diff and any(isinstance(each.content, bytes) for each in sources)
        if on_stderr and style != "text" and not fix_only:
            raise click.UsageError("the mended text of standard input is printed: leave --format out, or give --diff")
        fixing = Fixing(look, load_options, policy, unsafe=unsafe_fixes, diff=diff, notes=notes)
        loaded, mended = run_fixes(sources, fixing)
        if diff or fix_only:
            ctx.exit(UNUSABLE if any(each.unreadable for each in loaded) else FINDINGS if diff and mended else 0)
    else:
        on_stderr, mended = False, 0
        loaded = [look(each.content, each.name) for each in sources]
    loaded, seen = [replace(each, diagnostics=policy.apply(each.diagnostics)) for each in loaded], loaded
    allowed = sum(len(each.diagnostics) for each in seen) - sum(len(each.diagnostics) for each in loaded)
    findings = [Findings(each.path, each.diagnostics) for each in loaded]
    if style == "text":
        for each in findings:
            show(each, notes=notes, on_stderr=on_stderr)
    else:
        click.echo(REPORTERS[style](findings), nl=False)
    fixed = f"; {mended} mended" if mended else ""
    click.echo(
        _summary(loaded) + (f"; {allowed} allowed" if allowed else "") + (fixed or _fixable(loaded, notes=notes)),
        err=True,
    )
    ctx.exit(_exit_code(loaded))


def _inspected(loaded: LoadResult, load_options: LoadOptions, passes: "Pipeline | None") -> LoadResult:
    try:
        return inspect(loaded, load_options, passes)
    except ReadOnlyPassError as error:
        raise click.UsageError(str(error)) from error
    except PassError as error:
        raise Unusable(str(error)) from error


def _fixable(loaded: list[LoadResult], *, notes: bool) -> str:
    least = Severity.INFO if notes else Severity.WARNING
    if not any(each.rule.fix and each.severity >= least for result in loaded for each in result.diagnostics):
        return ""
    from twinform.cli.fixing import fixable  # noqa: PLC0415 - clean files have no findings

    return fixable(loaded, least)


def _exit_code(loaded: list[LoadResult]) -> int:
    if any(each.unreadable for each in loaded):
        return UNUSABLE
    return 0 if all(each.accepted for each in loaded) else FINDINGS


def _summary(loaded: list[LoadResult]) -> str:
    counts = Counter(diagnostic.severity for each in loaded for diagnostic in each.diagnostics)
    found = ", ".join(_count(counts[severity], word) for severity, word in _WORDS.items())
    unreadable = sum(each.unreadable for each in loaded)
    return f"{_count(len(loaded), 'file')}: {found}{f'; {unreadable} could not be read' if unreadable else ''}"


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
