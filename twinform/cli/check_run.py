"""A run of `twinform check`: what is done with the files that were found."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.baseline_file import Baselines, KnownOptions
from twinform.cli.check_plan import CheckPlan, folders_asked
from twinform.cli.check_report import CheckReport, ExitOptions
from twinform.cli.checked_file import CheckedFile, CheckTask, is_unusable
from twinform.cli.command import FINDINGS, UNUSABLE
from twinform.cli.config_file import ConfigError
from twinform.cli.file_runs import FileRun, RunOptions, open_file_run
from twinform.cli.inputs import InputSource, Remember, model_inputs
from twinform.cli.model_files import Exclusion, is_checked
from twinform.cli.nearest_projects import finding_of
from twinform.cli.project_options import OptionsByFile
from twinform.compiler import LoadResult
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic


class CheckOptions(NamedTuple):
    """What is done with the findings, and with the files."""

    style: str
    notes: bool
    every: bool
    output_file: Path | None
    stdin_filename: str | None
    watch: bool
    fix: bool
    unsafe_fixes: bool
    diff: bool
    fix_only: bool
    add_allow: bool

    @property
    def fixes(self) -> bool:
        """Whether files are fixed, or what would be fixed is printed."""
        return (self.fix or self.diff or self.fix_only) and not self.add_allow

    def require_consistent(self, words: Sequence[str], *, updates: bool) -> None:
        """Refuse options that contradict each other.

        Raises:
            click.UsageError: some do.
        """
        changes = self.fixes or self.add_allow or updates
        if self.watch and (self.style != "text" or changes or self.output_file or "-" in words):
            raise click.UsageError(
                "--watch prints text, of files: leave --format, --output-file, --update-baseline, --add-allow, --fix "
                "and - out"
            )
        if self.add_allow and (self.fix or self.fix_only or updates or "-" in words):
            raise click.UsageError("--add-allow changes files: leave --fix, --update-baseline and - out")
        if self.stdin_filename and "-" not in words:
            raise click.UsageError("--stdin-filename names what comes from standard input: give - as an input")


@dataclass(slots=True)
class CheckRun:
    """The files of a run, found anew in each round of `--watch`, and what is known of them."""

    ctx: click.Context
    words: Sequence[str]
    options: CheckOptions
    exclusion: Callable[[], Exclusion]
    known: KnownOptions
    exit_options: ExitOptions
    run_options: RunOptions
    sources: Sequence[InputSource] = ()
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    by_file: OptionsByFile = field(init=False)
    plan: CheckPlan = field(init=False)
    _unsaved: dict[str, bytes] = field(init=False, default_factory=dict[str, bytes])
    _wrong: set[Path] = field(init=False, default_factory=set[Path])
    """Configurations that were reported."""

    def run(self) -> int:
        """Check the files; return the exit code.

        Raises:
            click.UsageError: options contradict each other, or there is nothing to check.
            Unusable: a file cannot be written, or a pass is at fault.
        """
        options = self.options
        options.require_consistent(self.words, updates=self.known.update_baseline)
        if options.watch:
            return self._watch()
        anew = options.fixes or options.add_allow
        file_run = FileRun() if anew else open_file_run("check", self.words, self.run_options)
        self._find(file_run.remember)
        if options.output_file is None:
            return self._work(file_run)
        from twinform.cli.outputs import Outputs, printed_text  # noqa: PLC0415 - most runs write no file

        outputs = Outputs([each.path for each in self.sources])
        with printed_text() as printed:
            code = self._work(file_run)
        outputs.add("--output-file", options.output_file, printed.getvalue())
        return outputs.write() or code

    def _find(self, remember: Remember = lambda _, make: make()) -> None:
        self.sources, self.arguments = model_inputs(
            self.words, self.exclusion(), is_checked, remember, stdin_name=self.options.stdin_filename
        )
        if self.options.stdin_filename and not self.options.fixes:
            self._take_for_unsaved()
        self.by_file = OptionsByFile(self.ctx, self.arguments, "check_passes", folders_asked(self.words), self._unsaved)
        self.plan = CheckPlan.of(self.sources, self.words, self.by_file.usual.load_options, remember)
        self._wrong.clear()

    def _take_for_unsaved(self) -> None:
        """Take the text of standard input for that of its file, as an editor has it, so that xacro is expanded."""
        read = [each for each in self.sources if isinstance(each.content, bytes)]
        self._unsaved = {os.path.realpath(each.name): each.content for each in read if isinstance(each.content, bytes)}
        self.sources = [each._replace(content=each.name) if each in read else each for each in self.sources]

    def _work(self, file_run: FileRun) -> int:
        report = self._new_report()
        if self.options.fixes:
            return self._fix(report)
        if self.options.add_allow:
            is_changed = self._add_allow(file_run, report)
            if self.options.diff:
                return FINDINGS if is_changed else 0
            report = self._new_report()
        self._check(file_run, report.add, report)
        file_run.end()
        return report.end()

    def _check(self, file_run: FileRun, take: Callable[[CheckedFile], None], report: CheckReport) -> None:
        self._wrong.clear()
        with file_run.on(CheckedFile, [self._task(source, report) for source in self.sources]) as results:
            for each in results:
                take(each)

    def _new_report(self) -> CheckReport:
        return CheckReport(
            self.options.style,
            notes=self.options.notes,
            every=self.options.every,
            baselines=Baselines(self.known, self.by_file.baseline_of),
            arguments=self.plan.shared(self.arguments, len(self.sources)),
            exit_options=self.exit_options,
        )

    def _task(self, source: InputSource, report: CheckReport) -> CheckTask:
        name = source.name
        own, error = self.by_file.unless_wrong(name)
        return CheckTask(
            source,
            own.load_options,
            own.passes,
            bool(self.ctx.params.get("expand_includes")),
            report.reporting(name, own.policy),
            self.plan.roles.get(name, "robot"),
            name in self.plan.named,
            self._first_finding(error, name) if error else None,
        )

    def _first_finding(self, error: ConfigError, name: str) -> Diagnostic | None:
        """Return the finding about a configuration for the first of the files that it is for."""
        if error.file in self._wrong:
            return None
        self._wrong.add(error.file)
        return finding_of(error, name)

    def _add_allow(self, file_run: FileRun, report: CheckReport) -> bool:
        """Write comments that allow what is reported, or print them; return whether there are any."""
        from twinform.cli.add_allow import allow_found, print_allowed  # noqa: PLC0415 - it seldom happens
        from twinform.cli.outputs import show_differences, write_back  # noqa: PLC0415 - as above

        found: list[Diagnostic] = []
        report.shown = None
        self._check(file_run, lambda each: found.extend(report.new_findings(each.findings)), report)
        allowed = allow_found(self.sources, found)
        if self.options.diff:
            return show_differences(allowed.rewrites)
        write_back(allowed.rewrites)
        print_allowed(allowed)
        return bool(allowed.rewrites)

    def _watch(self) -> int:
        from twinform.cli.watching import watch_models  # noqa: PLC0415 - it seldom happens

        def find() -> Sequence[InputSource]:
            self._find()
            return self.sources

        return watch_models(find, self._new_report, lambda source, report: report.add(self._task(source, report).do()))

    def _fix(self, report: CheckReport) -> int:
        """Fix files, or print what would change; report what is left, and return the exit code."""
        from twinform.cli.fix import Fixing, run_fixes  # noqa: PLC0415 - most runs only look

        options, silent = self.options, self.options.diff or self.options.fix_only
        report.on_stderr = not options.diff and any(isinstance(each.content, bytes) for each in self.sources)
        if report.on_stderr and report.style != "text" and not silent:
            raise click.UsageError("the fixed text of standard input is printed: leave --format out, or give --diff")

        def look(content: str | bytes, name: str, unsaved: Mapping[str, bytes]) -> LoadResult:
            return self._task(InputSource(content, name), report).with_unsaved(unsaved).look()

        def fixing(source: InputSource) -> Fixing:
            own, _ = self.by_file.unless_wrong(source.name)
            return Fixing(
                look, own.load_options, own.policy, unsafe=options.unsafe_fixes, diff=options.diff, notes=options.notes
            )

        loaded, report.fixed = run_fixes(self.sources, fixing)
        named = self.plan.named
        if silent:
            unusable = any(is_unusable(each, named=each.path in named) for each in loaded)
            return UNUSABLE if unusable else FINDINGS if options.diff and report.fixed else 0
        for source, each in zip(self.sources, loaded, strict=True):
            reporting = report.reporting(source.name, fixing(source).policy)
            report.add(CheckedFile.of(each, reporting, named=source.name in named))
        return report.end()
