"""`twinform fix`, and the fixes of `check --fix`: their options, and the messages about them."""

import os
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files, pipelines
from twinform.cli.followed import describe_followed, followed_files
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, file_options, model_inputs
from twinform.cli.instrumentation import mesh_progress
from twinform.cli.model_files import is_fixable, is_plain
from twinform.cli.outputs import Rewrite, show_differences, write_back
from twinform.cli.printing import notes_option, print_line, show
from twinform.cli.project_options import OptionsByFile, pipeline_option
from twinform.cli.rule_options import policy_options
from twinform.compiler import (
    CompileError,
    ConversionRequest,
    Language,
    LoadOptions,
    LoadResult,
    as_refused,
    inspect,
    read,
)
from twinform.compiler.fixing import ANOTHER_ROBOT, FixResult, Refused, Texts, apply_fixes_by, new_rules
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Policy, Safety, Severity
from twinform.diagnostics.reporters import FileFindings
from twinform.diagnostics.wording import plural
from twinform.passes import FilesPass, PassError, Pipeline

Look = Callable[[str | bytes, str, Mapping[str, bytes]], LoadResult]
"""Checks a file, or the bytes of one under its name; other files may have texts that are not written yet."""


@dataclass(frozen=True, slots=True)
class Fixing:
    """How files are fixed; with `diff` nothing is written, and notes are fixed only with `notes`."""

    look: Look
    load_options: LoadOptions
    policy: Policy
    unsafe: bool = False
    diff: bool = False
    notes: bool = False

    def wants(self, finding: Diagnostic) -> bool:
        """Whether a finding is shown, and so may be fixed."""
        # A command that changes a file for a reason that it does not print would surprise.
        return bool(self.policy.apply([finding])) and (self.notes or finding.severity > Severity.INFO)


class FixedSource(NamedTuple):
    """A fixed file: its findings now, its new text, messages about the fixes, their number, and what it includes."""

    loaded: LoadResult
    rewrite: Rewrite | None
    news: list[str]
    number: int
    included: tuple[Rewrite, ...] = ()


def run_fixes(sources: Sequence[InputSource], fixing: Callable[[InputSource], Fixing]) -> tuple[list[LoadResult], int]:
    """Fix files, and write them or print what would change; return their findings then, and the number of fixes.

    Raises:
        Unusable: a file cannot be written.
    """
    done = fix_sources(sources, fixing)
    rewrites = merged(rewrite for each in done for rewrite in (each.rewrite, *each.included) if rewrite)
    if any(fixing(each).diff for each in sources):
        show_differences(rewrites)
    else:
        write_back(rewrites)
    for line in (line for each in done for line in each.news):
        print_line(line, err=True)
    return [each.loaded for each in done], sum(each.number for each in done)


def fix_sources(sources: Sequence[InputSource], fixing: Callable[[InputSource], Fixing]) -> list[FixedSource]:
    """Fix files one after the other without writing them; what one changes of a shared file, the next ones read."""
    pending: dict[str, bytes] = {}
    done: list[FixedSource] = []
    for source in sources:
        fixed = fix_source(source, fixing(source), pending)
        if fixed.included and not _suits_others(source, sources, fixing, pending, _texts_of(fixed.included)):
            closed = tuple(each.source.name for each in fixed.included)
            fixed = fix_source(source, fixing(source), pending, closed)
            fixed.news.append(f"{source.name}: not changed, for other robots: {', '.join(closed)}")
        if fixed.rewrite and is_expanded(source, fixing(source).load_options):
            pending |= _texts_of((fixed.rewrite, *fixed.included))
        done.append(fixed)
    return done


def merged(rewrites: Iterable[Rewrite]) -> list[Rewrite]:
    """Return one rewrite for each file, from its first text to its last."""
    found: dict[str, Rewrite] = {}
    for each in rewrites:
        key = each.source.name if each.is_stream else os.path.realpath(each.source.name)
        first = found.get(key)
        found[key] = each if first is None else replace(first, after=each.after)
    return [*found.values()]


def _texts_of(rewrites: Iterable[Rewrite]) -> dict[str, bytes]:
    return {os.path.realpath(each.source.name): each.after for each in rewrites}


def _suits_others(
    source: InputSource,
    sources: Sequence[InputSource],
    fixing: Callable[[InputSource], Fixing],
    pending: Mapping[str, bytes],
    changed: Mapping[str, bytes],
) -> bool:
    """Whether nothing new is found in the other robots that include the files which one robot changes."""
    for other in sources:
        way = fixing(other)
        if other is source or not is_expanded(other, way.load_options):
            continue
        path = os.path.realpath(other.name)
        read = {path, *(file for file, _ in IncludeGraph(way.load_options.search).closure(path))}
        if read.isdisjoint(changed):
            continue
        before = way.look(other.content, other.name, pending)
        if new_rules(before, way.look(other.content, other.name, {**pending, **changed}), Severity.WARNING):
            return False
    return True


def is_expanded(source: InputSource, load_options: LoadOptions) -> bool:
    """Whether a file is one of xacro, or of MJCF, which may include others."""
    if isinstance(source.content, bytes):
        return False
    if source.format == "mjcf":
        return True
    if load_options.xacro is False:
        return False
    return bool(load_options.xacro) or source.name.lower().endswith(XACRO)


def fix_source(
    source: InputSource, fixing: Fixing, pending: Mapping[str, bytes] | None = None, closed: Collection[str] = ()
) -> FixedSource:
    """Fix a file without writing it.

    Of a xacro file, those that it includes are fixed too, except `closed` ones; what is `pending` is their text, by
    paths without links.
    """
    sink = DiagnosticSink(source.name)
    pending = pending or {}
    try:
        data = _read(source, sink, fixing.load_options, pending)
    except UnreadableError:
        return FixedSource(LoadResult(source.name, None, tuple(sink.diagnostics), unreadable=True), None, [], 0)
    expands = is_expanded(source, fixing.load_options)

    def look(texts: Texts) -> LoadResult:
        if not expands:
            return fixing.look(texts[""], source.name, {})
        files = {os.path.realpath(name or source.name): text for name, text in texts.items()}
        return fixing.look(source.content, source.name, {**pending, **files})

    found = apply_fixes_by(
        look,
        data,
        unsafe=fixing.unsafe,
        wanted=fixing.wants,
        load_options=fixing.load_options,
        closed=closed,
    )
    rewrite = Rewrite(source, data, found.data)
    included = tuple(Rewrite(InputSource(name, name), *texts) for name, texts in found.included.items())
    news = _describe(source.name, found, "would fix" if fixing.diff else "fixed")
    return FixedSource(found.left, rewrite, news, len(found.applied), included)


def _read(source: InputSource, sink: DiagnosticSink, load_options: LoadOptions, pending: Mapping[str, bytes]) -> bytes:
    """Read the text of a file.

    Raises:
        UnreadableError: it cannot be read.
    """
    if isinstance(source.content, bytes):
        return source.content
    known = pending.get(os.path.realpath(source.name))
    if known is not None:
        return known
    path = Path(source.content)
    return read_bytes(path, sink, load_options.limits, load_options.search.readable(path))


_MOST_SHOWN = 20


def _describe(name: str, found: FixResult, verb: str) -> list[str]:
    """Say what was fixed in a file by rule, what was guessed, how the robot differs, and what was not fixed."""
    counts = Counter(each.rule.name for each in found.applied)
    shown = ", ".join(f"{count} x {rule}" for rule, count in counts.most_common())
    lines = [f"{name}: {verb} {shown}"] if counts else []
    guesses = [each for each in found.applied if each.fix and each.fix.safety is not Safety.SAFE]
    lines += _first(name, [f"unsafe: {_title(each)}" for each in guesses])
    lines += [f"{name}: {verb} in {', '.join(found.included)}"] if found.included else []
    lines += _first(name, [f"the robot differs: {each}" for each in found.changes])
    return lines + _first(name, [f"not fixed: {_title(each.finding)}: {_reason(each)}" for each in found.refused])


def _title(finding: Diagnostic) -> str:
    title = finding.fix.title if finding.fix else finding.message
    return f"line {finding.location.line}: {title} [{finding.rule.name}]"


def _reason(refused: Refused) -> str:
    if refused.new == (ANOTHER_ROBOT,):
        return "another robot would come of it"
    return f"{', '.join(refused.new)} would be found then"


def _first(name: str, lines: list[str]) -> list[str]:
    more = [f"{name}: and {len(lines) - _MOST_SHOWN} more"] if len(lines) > _MOST_SHOWN else []
    return [*(f"{name}: {line}" for line in lines[:_MOST_SHOWN]), *more]


Report = Callable[[str, tuple[Diagnostic, ...]], None]
"""Prints the findings of a file."""


EXAMPLES = {
    "Fix what can be fixed": "twinform fix robot.urdf",
    "Show what a guess would change too": "twinform fix robot.urdf --unsafe-fixes --diff",
    "Run a pass on a file": "twinform fix robot.urdf --passes 'fill-limits{effort=100}'",
}


@click.command("fix", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN...", nargs=-1, required=True, shell_complete=files)
@click.option(
    "--passes",
    metavar="PIPELINE",
    callback=pipeline_option("passes"),
    shell_complete=pipelines,
    help="Passes to run then, such as 'fill-limits{effort=100}', or @NAME for one that the configuration names.",
)
@click.option("--unsafe-fixes", is_flag=True, help="Fix what is a guess too, or may make another robot of a file.")
@click.option("--diff", is_flag=True, help="Print what would change, and write nothing; exit code 1 if anything.")
@notes_option
@policy_options
@exclude_options
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    passes: Pipeline | None,
    *,
    unsafe_fixes: bool,
    diff: bool,
    notes: bool,
    exclude: tuple[str, ...],
    force_exclude: bool,
    **_options: object,
) -> None:
    """Fix robot models in their files, and run passes on them.

    IN are URDF, SDF, MJCF or xacro files, folders of them, or globs in quotes; - is standard input, which goes to
    standard output. Passes are for URDF and SDF without xacro; fixes of xacro are made where the text is written, in
    all files of it. Only what a fix or a pass changes is changed: comments, layout and the spelling of all else stay.
    Where a pass renames, files that name the parts follow: SRDF, and parameters of controllers, MoveIt and Nav2. All is
    written, or, where a pass cannot run, nothing. Exit code: 0 where all went well, 1 with errors, 2 where a file could
    not be read or written.
    """
    kind = is_plain if passes else is_fixable
    sources, arguments = model_inputs(words, exclusion_of(ctx, exclude, force=force_exclude), kind)
    by_file = OptionsByFile(ctx, arguments)

    def look(content: str | bytes, name: str, unsaved: Mapping[str, bytes]) -> LoadResult:
        load_options = by_file.of(name).load_options.with_unsaved(unsaved)
        return as_refused(inspect(read(content, load_options, name=name), load_options))

    def report(name: str, diagnostics: tuple[Diagnostic, ...]) -> None:
        show(FileFindings(name, by_file.of(name).policy.apply(diagnostics)), notes=notes, on_stderr=True)

    def fixing(source: InputSource) -> Fixing:
        own = by_file.of(source.name)
        return Fixing(look, own.load_options, own.policy, unsafe=unsafe_fixes, diff=diff, notes=notes)

    for source in sources:
        _require_model(source, passes)
    done = fix_sources(sources, fixing)
    runs = [_run(source, each, passes, fixing(source), report) for source, each in zip(sources, done, strict=True)]
    rewrites = merged(rewrite for each in runs if not isinstance(each, int) for rewrite in each)
    if any(isinstance(each, int) for each in runs):
        if len(runs) > 1:
            wrong = sum(isinstance(each, int) for each in runs)
            print_line(f"nothing is written: {wrong} of {plural(len(runs), 'file')} could not be changed", err=True)
        ctx.exit(max(each for each in runs if isinstance(each, int)))
    robots = {Path(each.source.name): each.before for each in rewrites if not each.is_stream}
    followed = followed_files(robots, passes, by_file.usual.load_options) if passes else []
    rewrites += [Rewrite(InputSource(str(each.path), str(each.path)), each.before, each.after) for each in followed]
    for line in (line for each in followed for line in describe_followed(each)):
        print_line(line, err=True)
    if diff:
        ctx.exit(FINDINGS if show_differences(rewrites) else 0)
    write_back(rewrites)


def _require_model(source: InputSource, passes: Pipeline | None) -> None:
    """Require a model whose own text can be changed.

    Raises:
        click.UsageError: it is JSON or xacro, or a pass makes other files.
    """
    if source.format == "json" or (passes and (source.format == "mjcf" or source.name.lower().endswith(XACRO))):
        raise click.UsageError(f"{source.name} is not URDF or SDF: change it by hand, or convert it first")
    made = [step.only_file for step in passes or () if isinstance(step, FilesPass) and step.only_file]
    if made:
        raise click.UsageError(f"a pass writes {made[0]} beside the result: give it to convert")


def _run(
    source: InputSource, fixed: FixedSource, passes: Pipeline | None, fixing: Fixing, report: Report
) -> list[Rewrite] | int:
    """Run passes on a fixed file; return the new texts, or the exit code if it cannot be changed."""
    rewrite, news = fixed.rewrite, fixed.news
    if rewrite is None or fixed.loaded.unreadable:
        report(source.name, fixed.loaded.diagnostics)
        return UNUSABLE
    if passes:
        try:
            request = ConversionRequest(to=_format_of(rewrite), passes=passes)
            with mesh_progress(passes):
                updated = convert_in_place(request, source.name, fixing.load_options, data=rewrite.after)
        except CompileError as error:
            report(source.name, error.diagnostics)
            return UNUSABLE if error.unreadable else FINDINGS
        except PassError as error:
            raise Unusable(str(error)) from error
        report(source.name, updated.conversion.diagnostics)
        rewrite = Rewrite(source, rewrite.before, updated.data, updated.conversion.side_files)
        news = [*news, f"{source.name}: {plural(len(updated.changes), 'change')} by passes"]
    for line in news:
        print_line(line, err=True)
    return [rewrite, *fixed.included]


def _format_of(rewrite: Rewrite) -> Language:
    """Return the format of a file."""
    return "urdf" if InputSource(rewrite.after, rewrite.source.name).format == "urdf" else "sdf"
