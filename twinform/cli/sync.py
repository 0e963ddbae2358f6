"""`twinform sync`."""

from collections.abc import Sequence
from dataclasses import field, replace
from pathlib import Path

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files
from twinform.cli.config_defaults import settings_of
from twinform.cli.diff import tolerance_option
from twinform.cli.inputs import InputSource, reading_options, split_words
from twinform.cli.outputs import Outputs, Rewrite, show_differences
from twinform.cli.printing import all_option, notes_option, print_line, print_report
from twinform.cli.project_options import OptionsByFile, request_options, whole_request
from twinform.cli.rule_options import policy_options
from twinform.cli.run_conversion import describe_change, show_findings
from twinform.cli.sync_groups import SyncGroup, groups_of, target_format
from twinform.compiler import CompileError, ConversionRequest
from twinform.compiler.compare import ComparisonOptions
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.sync_reporters import REPORTERS, SyncedGroup
from twinform.compiler.syncing import AnotherRobotError, SyncedFile, SyncOptions, SyncState, sync_file
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic
from twinform.diagnostics.wording import plural
from twinform.passes import PassError, Pipeline
from twinform.request_options import Language

EXAMPLES = {
    "Let the SDF follow the URDF": "twinform sync robot.urdf robot.sdf",
    "Is any file out of date? For CI": "twinform sync robot.urdf robot.sdf --check",
    "Show what would change": "twinform sync robot.urdf robot.sdf --diff",
    "Take another file than the first one for the source": "twinform sync robot.urdf robot.sdf --source robot.sdf",
}


@click.command("sync", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="[FILE... | @GROUP...] [NAME:=VALUE...]", nargs=-1, shell_complete=files)
@click.option(
    "--source",
    type=click.Path(path_type=Path),
    metavar="FILE",
    shell_complete=files,
    help="The file that the others follow; else the one that the configuration names first, or the first one.",
)
@click.option("--check", is_flag=True, help="Write nothing; exit code 1 where a file is out of date or missing.")
@click.option("--diff", is_flag=True, help="Print what would change, and write nothing; exit code 1 if anything.")
@click.option("--rewrite", is_flag=True, help="Write a file anew where what has changed cannot be changed in it alone.")
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print the report.")
@click.option("--model", metavar="NAME", help="The model that is meant, where a file has several.")
@tolerance_option
@request_options
@notes_option
@all_option
@policy_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    source: Path | None,
    *,
    check: bool,
    diff: bool,
    rewrite: bool,
    style: str,
    model: str | None,
    tolerance: float,
    notes: bool,
    every: bool,
    reading: ReadingOptions,
    **_options: object,
) -> None:
    """Let the files of one robot follow one that is their source.

    The files are URDF, SDF and MJCF of one robot, and the source may be xacro. Each is compared with what the source
    converts to, as by `twinform diff`, and follows it where it is out of date: only what differs is changed in its
    text. A missing file is made. Without files, all groups of the table [sync] of twinform.toml are kept the same;
    @NAME is one of them, and so is a file of it. All files are written, or, where one has an error, none. Exit code: 0
    without errors, 1 with errors, or out of date with --check or --diff, 2 where a file could not be read or written.
    """
    typed, arguments = split_words(words) if words else ([], {})
    groups = groups_of(typed, source, settings_of(ctx).synced)
    options = SyncOptions(make=not check or diff, rewrite=rewrite, comparison=ComparisonOptions(tolerance))
    run = _SyncRun(OptionsByFile(ctx, arguments), options, reading, model, notes, every)
    found = [run.sync(group) for group in groups]
    if run.codes:
        if not (check or diff) and sum(len(group.others) for group in groups) > 1:
            print_line(f"nothing is written: {plural(len(run.codes), 'file')} could not be followed", err=True)
        ctx.exit(max(run.codes))
    if diff:
        ctx.exit(FINDINGS if show_differences(map(_rewrite, _changing(found))) else 0)
    print_report(REPORTERS[style](found), style)
    if check:
        ctx.exit(FINDINGS if [*_changing(found)] else 0)
    _write(groups, found, run)


def _changing(groups: Sequence[SyncedGroup]) -> list[SyncedFile]:
    """Return the files that are not up to date."""
    return [file for group in groups for file in group.files if file.state is not SyncState.CURRENT]


def _rewrite(file: SyncedFile) -> Rewrite:
    return Rewrite(InputSource(file.path, file.path), file.read or b"", file.data or b"", file.side_files)


@dataclass(slots=True)
class _SyncRun:
    """The options of one run, and the exit codes of the files that have errors."""

    by_file: OptionsByFile
    options: SyncOptions
    reading: ReadingOptions
    model: str | None
    notes: bool
    every: bool
    codes: list[int] = field(default_factory=list[int])

    def sync(self, group: SyncGroup) -> SyncedGroup:
        """Compare the files of a group with their source; those with errors are left out."""
        if not group.source.is_file():
            raise Unusable(f"{group.source} is no file, and the others are made of it")
        if InputSource(str(group.source), str(group.source)).format == "json":
            raise click.UsageError(f"{group.source} is JSON: convert it to a file that people edit first")
        targets: list[tuple[Path, Language]] = [(file, target_format(file, group.source)) for file in group.others]
        made = [self._sync_file(group.source, *each) for each in targets]
        return SyncedGroup(group.name, str(group.source), [each for each in made if each is not None])

    def _sync_file(self, source: Path, file: Path, language: Language) -> SyncedFile | None:
        """Compare one file with its source; None if there is an error, which is printed."""
        own = self.by_file.of(str(source))
        options = replace(self.options, carriers_as_found=own.request.get("carriers") is None)
        try:
            made = sync_file(self._request(source, language), source, file, own.load_options, options)
        except AnotherRobotError as error:
            raise Unusable(str(error)) from error
        except CompileError as error:
            self._show(source, error.diagnostics)
            self.codes.append(UNUSABLE if error.unreadable else FINDINGS)
            return None
        except PassError as error:
            raise Unusable(str(error)) from error
        if not self._show(source, made.diagnostics):
            self.codes.append(FINDINGS)
        return made

    def _request(self, source: Path, language: Language) -> ConversionRequest:
        own = self.by_file.of(str(source))
        wanted = whole_request(own.request, self.reading, model=self.model)
        request = replace(ConversionRequest.of(language, wanted), passes=own.passes or Pipeline())
        return request if language == "sdf" else replace(request, sdf_version=None)

    def _show(self, source: Path, found: tuple[Diagnostic, ...]) -> bool:
        policy = self.by_file.of(str(source)).policy
        name = str(source)
        return show_findings(InputSource(name, name), policy.apply(found), notes=self.notes, every=self.every)


def _write(groups: Sequence[SyncGroup], found: Sequence[SyncedGroup], run: _SyncRun) -> None:
    """Write all files that are not up to date, and say what was changed in each.

    Raises:
        Unusable: a file cannot be written, or has changed since it was read.
    """
    settings = settings_of(run.by_file.ctx).path
    read = [*(group.source for group in groups), *([settings] if settings else [])]
    outputs = Outputs(read, [file for group in groups for file in group.others])
    for file in _changing(found):
        path = Path(file.path)
        outputs.add("sync", path, file.data or b"")
        if file.read is not None:
            outputs.as_read[path] = file.read
        outputs.add_beside(path, file.side_files)
        outputs.news += _news(file)
    outputs.write(run.by_file.usual.load_options.search.seen)


def _news(file: SyncedFile) -> list[str]:
    if file.anew:
        return [f"{file.path} is written{'' if file.read is None else ' anew'}"]
    changes = [describe_change(Path(file.path), change) for change in file.changes]
    return [*changes, f"{file.path}: {plural(len(changes), 'change')}"]
