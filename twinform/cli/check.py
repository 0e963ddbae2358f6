"""`twinform check`: its options, what it prints file by file, its exit code, and the baseline of known findings."""

import os
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from twinform.cli.check_plan import CheckPlan, folders_asked
from twinform.cli.checked_file import CheckedFile, CheckTask, Reporting, is_elsewhere, is_unusable
from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable, combine_options
from twinform.cli.completion import files, pipelines
from twinform.cli.config_defaults import RuleSettings, settings_of
from twinform.cli.file_runs import FileRun, RunOptions, open_file_run, run_options
from twinform.cli.flags import group
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, model_inputs, reading_options
from twinform.cli.model_files import is_checked
from twinform.cli.printing import all_option, notes_option, plural, print_document, print_line, show
from twinform.cli.project_options import OptionsByFile, consumers_option, pipeline_option, policy_options
from twinform.compiler import LoadResult
from twinform.compiler.input.load_options import ReadingOptions
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Policy, Safety, Severity
from twinform.diagnostics.reporters import REPORTERS, FileFindings
from twinform.diagnostics.reporters.file_findings import cause_of
from twinform.file_access import OutsideError, Readable

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from twinform.cli.fix import Fixing
    from twinform.diagnostics.baseline import Baseline
    from twinform.passes import Pipeline
    from twinform.profiles import Profile


baseline_options = combine_options(
    click.option(
        "--baseline",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Findings that are known, and are not reported; else that of the configuration.",
    ),
    click.option(
        "--update-baseline", is_flag=True, help="Write what is found now into the baseline, and report none of it."
    ),
)
"""Gives a command `--baseline FILE` and `--update-baseline`."""


@dataclass(frozen=True, slots=True)
class RelativeNames:
    """Gives the names of files relative to the folder of a baseline."""

    folder: str

    def __call__(self, name: str, /) -> str:
        """Return a name with `/` between its parts; that of a stream stays as it is."""
        if name.startswith("<"):
            return name
        return os.path.relpath(os.path.abspath(name), self.folder).replace(os.sep, "/")  # noqa: PTH100 - links stay links


class BaselineFile:
    """The baseline of a run, and its file."""

    def __init__(self, file: Path, *, update: bool) -> None:
        """Read the file, which may be missing if it is to be updated.

        Raises:
            Unusable: it cannot be read, or is no baseline.
        """
        from twinform.diagnostics.baseline import BaselineRun  # noqa: PLC0415 - few runs have one

        self.file, self.update = file, update
        self.folder = os.path.abspath(file.parent)  # noqa: PTH100 - links stay links
        self.run = BaselineRun(_read_baseline(file, missing_ok=update), RelativeNames(self.folder))

    def write(self) -> str:
        """Update the file, if that was asked for; return a message.

        Raises:
            Unusable: the file cannot be written.
        """
        if not self.update:
            return _count_gone(self.run.gone)
        from twinform.compiler import write_atomically  # noqa: PLC0415 - few runs write one

        made = self.run.updated(lambda name: name.startswith("<") or _is_there(Path(self.folder, name)))
        try:
            write_atomically(self.file, made.to_json())
        except OSError as error:
            raise Unusable(f"cannot write {self.file}: {error.strerror}") from error
        return f"{self.file}: {plural(sum(made.counts.values()), 'finding')}"


def _is_there(path: Path) -> bool:
    """Whether there is a file; also True if that cannot be found out."""
    try:
        path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError:
        return True
    return True


def _count_gone(count: int) -> str:
    if not count:
        return ""
    entries = "1 entry of the baseline does" if count == 1 else f"{count} entries of the baseline do"
    return f"{entries} not occur any more: --update-baseline takes {'it' if count == 1 else 'them'} out"


def baseline_of(ctx: click.Context, file: Path | None, *, update: bool) -> BaselineFile | None:
    """Return the baseline of the option, or else of the project.

    Raises:
        click.UsageError: it is to be updated, and no file is named.
        Unusable: it cannot be read.
    """
    file = file or settings_of(ctx).baseline_file
    if file is None and update:
        raise click.UsageError("--update-baseline needs --baseline FILE, or a baseline in the configuration")
    return BaselineFile(file, update=update) if file else None


def _read_baseline(file: Path, *, missing_ok: bool) -> "Baseline":
    from twinform.diagnostics.baseline import Baseline, BaselineError  # noqa: PLC0415 - few runs have one

    try:
        return Baseline.parse(Readable.of(file).read(file).decode("utf-8-sig"))
    except FileNotFoundError as error:
        if missing_ok:
            return Baseline()
        raise Unusable(f"there is no baseline {file}: --update-baseline makes it") from error
    except OSError as error:
        advice = f"; {error.help}" if isinstance(error, OutsideError) else ""
        raise Unusable(f"cannot read {file}: {error.strerror}{advice}") from error
    except UnicodeDecodeError as error:
        raise Unusable(f"{file}: this is no baseline: it is not in UTF-8") from error
    except BaselineError as error:
        raise Unusable(f"{file}:{error.line}: {error}" if error.line else f"{file}: {error}") from error


_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_FOR_PEOPLE = frozenset({"text", "concise"})
_STREAMED = _FOR_PEOPLE | {"github"}
"""Formats that are printed file by file; the others are one document."""


class ExitOptions(NamedTuple):
    """What the exit code depends on besides errors, and whether the rules that were found are counted."""

    max_warnings: int | None = None
    exit_zero: bool = False
    statistics: bool = False


USUAL_EXIT = ExitOptions()
exit_options = group(
    "exit_options",
    ExitOptions,
    click.option("--max-warnings", type=click.IntRange(min=0), metavar="N", help="Exit code 1 with more warnings."),
    click.option("--exit-zero", is_flag=True, help="Exit code 0 whatever is found in the files."),
    click.option("--statistics", is_flag=True, help="Say how often each rule was found."),
)
"""Gives a command `--max-warnings`, `--exit-zero` and `--statistics`, as `exit_options`."""


class OnceInAllFiles:
    """Leaves out findings about an included file that were reported before, for another robot or call of a macro."""

    def __init__(self) -> None:
        self.repeated = 0
        self._seen: set[object] = set()

    def is_new(self, finding: Diagnostic) -> bool:
        """Whether a finding about an included file was not asked about before."""
        where = finding.location
        key = (os.path.abspath(where.file), where.line, cause_of(finding))  # noqa: PTH100 - many strings
        is_new = key not in self._seen
        self._seen.add(key)
        self.repeated += not is_new
        return is_new


class CheckReport:
    """The report of a run in one format; it keeps no models, since there may be thousands."""

    def __init__(
        self,
        style: str,
        *,
        notes: bool,
        every: bool = False,
        baseline: BaselineFile | None = None,
        arguments: Iterable[str] = (),
        exit_options: ExitOptions = USUAL_EXIT,
    ) -> None:
        self.style, self.notes, self.every, self.baseline = style, notes, every, baseline
        self.exit, self.by_rule = exit_options, Counter[str]()
        self.unused, self.once = {*arguments}, OnceInAllFiles()
        self.on_stderr, self.fixed = False, 0
        self.fixes: Counter[Safety] = Counter()
        self.kept: list[FileFindings] = []
        self.counts: Counter[Severity] = Counter()
        self.files = self.unreadable = self.unusable = self.waiting = self.allowed = self.known = 0

    def reporting(self, name: str, policy: Policy) -> Reporting:
        """Return what is to be reported of the findings of a file."""
        return Reporting(
            policy,
            fixed=Severity.INFO if self.notes else Severity.WARNING,
            shown=Severity.INFO if self.notes or self.style not in _FOR_PEOPLE else Severity.WARNING,
            baseline=self.baseline and self.baseline.run.of_file(name),
            updates=bool(self.baseline and self.baseline.update),
        )

    def add(self, checked: CheckedFile) -> None:
        """Report on one file."""
        findings = self._without_known(checked.findings)
        self.allowed += checked.allowed
        self.known += checked.known
        self.files += 1
        self.unreadable += checked.unreadable
        self.unusable += checked.unusable
        self.waiting += checked.waits
        if checked.unused is not None:
            self.unused &= {*checked.unused}
        self.counts.update(each.severity for each in findings.diagnostics)
        least = Severity.INFO if self.notes else Severity.WARNING
        self.by_rule.update(each.rule.name for each in findings.diagnostics if each.severity >= least)
        self.fixes.update(each.fix.safety for each in findings.diagnostics if each.fix)
        if self.baseline:
            is_whole = not (checked.unreadable or checked.waits)
            self.baseline.run.add((findings.path, *checked.parts) if is_whole else (), checked.baselined)
        if self.style in _FOR_PEOPLE:
            short = self.style == "concise"
            show(findings, notes=self.notes, on_stderr=self.on_stderr, every=self.every, short=short)
        elif self.style in _STREAMED:
            print_document(REPORTERS[self.style]([findings]))
        else:
            self.kept.append(findings)

    def _without_known(self, findings: FileFindings) -> FileFindings:
        """Leave out what is known of files that others include: from another one of these, or from the baseline."""
        kept = tuple(each for each in findings.diagnostics if not self._is_known(each, findings.path))
        return findings if len(kept) == len(findings.diagnostics) else findings._replace(diagnostics=kept)

    def _is_known(self, finding: Diagnostic, path: str) -> bool:
        if not is_elsewhere(finding, path):
            return False
        if not self.once.is_new(finding):
            return True
        if self.baseline is None or self.baseline.run.unknown(path, [finding]):
            is_kept = self.baseline is None or not self.baseline.update or finding.severity is Severity.INFO
            return not is_kept
        self.known += 1
        return True

    def end(self) -> int:
        """Print the rest and the summary; return the exit code."""
        if self.style not in _STREAMED:
            print_document(REPORTERS[self.style](self.kept))
        news = self.baseline.write() if self.baseline else ""
        print_line(self._summary(), err=True)
        for rule, count in self.by_rule.most_common() if self.exit.statistics else ():
            print_line(f"{count:>6}  {rule}", err=True)
        for name in sorted(self.unused):
            print_line(f"no file has the argument {name!r}", err=True)
        if news:
            print_line(news, err=True)
        if self.unusable:
            return UNUSABLE
        excess = self.exit.max_warnings is not None and self.counts[Severity.WARNING] > self.exit.max_warnings
        if excess:
            print_line(f"more warnings than --max-warnings {self.exit.max_warnings}", err=True)
        return FINDINGS if (self.counts[Severity.ERROR] or excess) and not self.exit.exit_zero else 0

    def _summary(self) -> str:
        found = ", ".join(plural(self.counts[severity], word) for severity, word in _WORDS.items())
        more = (
            (self.unreadable, "could not be read"),
            (self.waiting, "not checked, for want of arguments or packages"),
            (self.once.repeated, "of the same places in other robots"),
            (self.allowed, "allowed"),
            (self.known, "in the baseline"),
            (self.fixed, "fixed"),
        )
        counts = "".join(f"; {count} {what}" for count, what in more if count)
        return f"{plural(self.files, 'file')}: {found}{counts}{self._fixable() if not self.fixed else ''}"

    def _fixable(self) -> str:
        """Say how many findings `--fix` would fix at most."""
        safe, unsafe = self.fixes[Safety.SAFE], self.fixes[Safety.UNSAFE]
        if safe and unsafe:
            return f"; {safe} fixable with --fix, {unsafe} more with --unsafe-fixes"
        if safe:
            return f"; {safe} fixable with --fix"
        return f"; {unsafe} fixable with --fix --unsafe-fixes" if unsafe else ""


EXAMPLES = {
    "Find mistakes": "twinform check robot.urdf",
    "Also what is legal and yet worth knowing, for a program": "twinform check robot.sdf --notes --format json",
    "Expand a xacro file with an argument of its own": "twinform check arm.urdf.xacro prefix:=left_",
    "What would these two programs make of it?": "twinform check robot.urdf --for drake,mujoco",
    "One rule is an error, another is left out": "twinform check robot.urdf --deny massless-link --allow missing-limit",
}


@click.command("check", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print findings.")
@notes_option
@all_option
@policy_options
@baseline_options
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    shell_complete=pipelines,
    help="Read-only passes, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@consumers_option
@exclude_options
@click.option("--watch", is_flag=True, help="Stay, and check what changes again, until Ctrl-C.")
@click.option("--fix", is_flag=True, help="Fix what can be fixed without another robot coming of it, in the files.")
@click.option("--unsafe-fixes", is_flag=True, help="Fix what is a guess too, or may make another robot of a file.")
@click.option("--diff", is_flag=True, help="Print what --fix would change, and write nothing; exit code 1 if anything.")
@click.option("--fix-only", is_flag=True, help="Fix, and report nothing of what is left.")
@exit_options
@run_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    notes: bool,
    every: bool,
    rules: RuleSettings,
    baseline: Path | None,
    update_baseline: bool,
    check_passes: "Pipeline | None",
    profiles: "tuple[Profile, ...]",
    exclude: tuple[str, ...],
    force_exclude: bool,
    watch: bool,
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    fix_only: bool,
    exit_options: ExitOptions,
    run: RunOptions,
    reading: ReadingOptions,
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files, folders of them, or globs in quotes; - is standard input. Arguments of xacro
    are written NAME:=VALUE. Exit code: 0 without errors, 1 with errors, 2 where a file that is named cannot be opened.
    """
    exclusion = exclusion_of(ctx, exclude, force=force_exclude)
    fixes = fix or diff or fix_only
    if watch and (style != "text" or update_baseline or fixes or "-" in words):
        raise click.UsageError("--watch prints text, of files: leave --format, --update-baseline, --fix and - out")
    file_run = FileRun() if watch or fixes else open_file_run("check", words, run)
    sources, arguments = model_inputs(words, exclusion, is_checked, file_run.remember)
    folders = folders_asked(words)
    options = OptionsByFile(ctx, arguments, reading, rules, check_passes, "check_passes", profiles, folders)
    plan = CheckPlan.of(sources, words, options.usual.load_options, file_run.remember)

    def new_report() -> CheckReport:
        known = baseline_of(ctx, baseline, update=update_baseline)
        return CheckReport(
            style,
            notes=notes,
            every=every,
            baseline=known,
            arguments=plan.shared(arguments, len(sources)),
            exit_options=exit_options,
        )

    def task(source: InputSource, report: CheckReport) -> CheckTask:
        load_options, policy, passes = options.of(source.name)
        reporting = report.reporting(source.name, policy)
        role, named = plan.roles.get(source.name, "robot"), source.name in plan.named
        return CheckTask(source, load_options, passes, bool(reading.get("expand_includes")), reporting, role, named)

    def look(content: str | bytes, name: str) -> LoadResult:
        return task(InputSource(content, name), report).look()

    def fixing(source: InputSource) -> "Fixing":
        from twinform.cli.fix import Fixing  # noqa: PLC0415 - most runs only look

        load_options, policy, _ = options.of(source.name)
        return Fixing(look, load_options, policy, unsafe=unsafe_fixes, diff=diff, notes=notes)

    if watch:
        from twinform.cli.watching import watch_models  # noqa: PLC0415 - it seldom happens

        def check(source: InputSource, report: CheckReport) -> None:
            report.add(task(source, report).do())

        def find() -> "Sequence[InputSource]":
            nonlocal plan
            found = model_inputs(words, exclusion, is_checked)[0]
            plan = CheckPlan.of(found, words, options.usual.load_options)
            return found

        ctx.exit(watch_models(find, new_report, check))
    report = new_report()
    if fixes:
        ctx.exit(_fix(sources, fixing, report, plan.named, diff=diff, silent=diff or fix_only))
    _check(file_run, [task(source, report) for source in sources], report)
    ctx.exit(report.end())


def _check(file_run: FileRun, tasks: "Sequence[CheckTask]", report: CheckReport) -> None:
    with file_run.on(CheckedFile, tasks) as results:
        for each in results:
            report.add(each)
    file_run.end()


def _fix(
    sources: "Sequence[InputSource]",
    fixing: "Callable[[InputSource], Fixing]",
    report: CheckReport,
    named: frozenset[str],
    *,
    diff: bool,
    silent: bool,
) -> int:
    """Fix files, or print what would change; report what is left unless `silent`, and return the exit code."""
    from twinform.cli.fix import run_fixes  # noqa: PLC0415 - most runs only look

    report.on_stderr = not diff and any(isinstance(each.content, bytes) for each in sources)
    if report.on_stderr and report.style != "text" and not silent:
        raise click.UsageError("the fixed text of standard input is printed: leave --format out, or give --diff")
    loaded, report.fixed = run_fixes(sources, fixing)
    if silent:
        unusable = any(is_unusable(each, named=each.path in named) for each in loaded)
        return UNUSABLE if unusable else FINDINGS if diff and report.fixed else 0
    for source, each in zip(sources, loaded, strict=True):
        reporting = report.reporting(source.name, fixing(source).policy)
        report.add(CheckedFile.of(each, reporting, named=source.name in named))
    return report.end()
