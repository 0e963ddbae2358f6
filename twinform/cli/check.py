"""`twinform check`."""

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

import click
import pydantic  # noqa: F401 # pyright: ignore[reportUnusedImport] - decisions: near the top of the stack

from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.findings import all_option, notes_option, placed, show
from twinform.cli.inputs import InputOptions, inputs, load_options_of, reading_options
from twinform.cli.pipeline_option import pipeline_option
from twinform.cli.policy import policy_of, policy_options
from twinform.compiler import LoadOptions, LoadResult, ReadOnlyPassError, inspect, read
from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import REPORTERS, Findings
from twinform.passes import PassError

if TYPE_CHECKING:
    from twinform.compiler.input.source_files import SourceFiles
    from twinform.passes import Pipeline

_FOR_PEOPLE = frozenset({"text", "concise"})
_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


@click.command("check")
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print findings.")
@notes_option
@all_option
@policy_options
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    help="Read-only passes, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    notes: bool,
    every: bool,
    allow: tuple[str, ...],
    deny: tuple[str, ...],
    check_passes: "Pipeline | None",
    expand_includes: bool,
    **input_options: Unpack[InputOptions],
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code: 0
    without errors, 1 with errors, 2 where a file could not be read.
    """
    sources, arguments = inputs(words)
    policy, load_options = policy_of(ctx, allow, deny), load_options_of(arguments, input_options)
    loaded = [read(each.content, load_options, name=each.name) for each in sources]
    if expand_includes:
        from twinform.compiler import expand  # noqa: PLC0415 - few runs read other files

        loaded = [expand(each, load_options) for each in loaded]
    loaded = [_inspected(each, load_options, check_passes) for each in loaded]
    loaded, seen = [replace(each, diagnostics=policy.apply(each.diagnostics)) for each in loaded], loaded
    allowed = sum(len(each.diagnostics) for each in seen) - sum(len(each.diagnostics) for each in loaded)
    if style in _FOR_PEOPLE:
        for each in loaded:
            found, short = Findings(each.path, each.diagnostics), style == "concise"
            show(found, notes=notes, on_stderr=False, every=every, short=short, files=_files(each))
    else:
        files = [placed(Findings(each.path, each.diagnostics), _files(each)) for each in loaded]
        click.echo(REPORTERS[style](files), nl=False)
    click.echo(_summary(loaded) + (f"; {allowed} allowed" if allowed else ""), err=True)
    ctx.exit(_exit_code(loaded))


def _inspected(loaded: LoadResult, load_options: LoadOptions, passes: "Pipeline | None") -> LoadResult:
    try:
        return inspect(loaded, load_options, passes)
    except ReadOnlyPassError as error:
        raise click.UsageError(str(error)) from error
    except PassError as error:
        raise Unusable(str(error)) from error


def _files(loaded: LoadResult) -> "SourceFiles | None":
    """The files that the findings about one are about; None without findings."""
    if not loaded.diagnostics:
        return None
    from twinform.compiler.input.source_files import SourceFiles  # noqa: PLC0415 - only findings have places

    return SourceFiles.of(loaded)


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
