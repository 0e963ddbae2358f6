"""One conversion of `twinform convert`: to a new file, in place, into an edited file, or split by models.

The target format and the output path of each input are decided here too.
"""

import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, get_args

import click

from twinform.cli.command import FINDINGS, UNUSABLE
from twinform.cli.gazebo_files import GazeboFiles
from twinform.cli.inputs import InputSource, format_of_suffix
from twinform.cli.instrumentation import InstrumentationOptions, mesh_progress
from twinform.cli.outputs import Output, Outputs, beside
from twinform.cli.printing import print_line, show
from twinform.cli.project_options import ResolvedOptions
from twinform.compiler import CompileError, Conversion, ConversionRequest, LoadOptions, read, run_conversion
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.root_names import without_endings
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy
from twinform.diagnostics.reporters import FileFindings, printable
from twinform.diagnostics.wording import cut, plural
from twinform.ir import Format
from twinform.passes import FilesPass, PassError, PassInstrumentation, Pipeline
from twinform.request_options import Language, RequestOptions
from twinform.storage.writing import folded, is_stream

if TYPE_CHECKING:
    from twinform.compiler import SplitWorld
    from twinform.compiler.in_place import TextChange, Updated


Target = Language
TARGETS: tuple[Target, ...] = get_args(Target)


class ConversionJob(NamedTuple):
    """One conversion, to standard output if `path` is None; with `in_place` only the changes are written."""

    source: InputSource
    target: Target
    path: Path | None
    in_place: bool = False


def jobs(sources: Sequence[InputSource], out: str | None, target: Target | None) -> list[ConversionJob]:
    """List the conversions that a command line asks for.

    Raises:
        click.UsageError: it contradicts itself, or does not say the target.
    """
    if out is None or out == "-":
        if len(sources) > 1:
            raise click.UsageError("several inputs need -o DIRECTORY")
        return [ConversionJob(source, target or _other_format(source), None) for source in sources]
    folder = Path(out)
    if not _is_folder(out, len(sources)):
        named = target or _target_called(folder.name)
        return [ConversionJob(source, named or _other_format(source), folder) for source in sources]
    if folder.exists() and not folder.is_dir():
        raise click.UsageError(f"several inputs need a directory, and {out} is a file")
    found = [_job_in_folder(folder, source, target or _other_format(source)) for source in sources]
    _require_distinct(found)
    return found


def jobs_in_place(sources: Sequence[InputSource], out: str | None, target: Target | None) -> list[ConversionJob]:
    """List the conversions of `--in-place`, which keep the format of each input.

    Raises:
        click.UsageError: an input is no file that can be changed in place, or another output is named.
    """
    if out is not None:
        raise click.UsageError("--in-place and -o contradict each other")
    return [_job_in_place(source, target) for source in sources]


def _job_in_place(source: InputSource, target: Target | None) -> ConversionJob:
    """Return the job of changing a file in place."""
    if isinstance(source.content, bytes):
        raise click.UsageError(f"{source.name} is no file that could be written in place")
    if source.name.lower().endswith(XACRO):
        raise click.UsageError(f"{source.name} would be replaced by what it expands to; name another file with -o")
    if source.format == "mjcf":
        raise click.UsageError(f"{source.name} is MJCF, which is written anew: name another file with --to mjcf -o")
    found = known_target(source.format)
    if found is None or target not in {None, found}:
        raise click.UsageError(f"{source.name} stays {found or 'what it is'} in its place; leave --to out")
    return ConversionJob(source, found, Path(source.content), in_place=True)


def _is_folder(out: str, count: int) -> bool:
    return count > 1 or Path(out).is_dir() or out.endswith(("/", os.sep))


def _target_called(name: str) -> Target | None:
    """Return the target of a file of a name; `.xml` is what files of MuJoCo are called."""
    return "mjcf" if name.lower().endswith(".xml") else known_target(format_of_suffix(name))


def known_target(word: str | None) -> Target | None:
    """Return the target of a name, if there is one."""
    return next((target for target in TARGETS if target == word), None)


def _other_format(source: InputSource) -> Target:
    """Return the format to convert a source to; if its own format is unknown, the compiler reports why."""
    if source.format == "json":
        raise click.UsageError(f"{source.name} is a JSON document, which can become any format: give --to")
    return Format(source.format or "urdf").counterpart.value


def _job_in_folder(folder: Path, source: InputSource, target: Target) -> ConversionJob:
    name = Path("stdin" if isinstance(source.content, bytes) else source.name)
    ending = "xml" if target == "mjcf" else str(target)
    bare = without_endings(name).name
    if target == "sdf" and ".world" in name.name[len(bare) :].lower():
        ending = "world"
    return ConversionJob(source, target, folder / f"{bare}.{ending}")


def _require_distinct(found: Sequence[ConversionJob]) -> None:
    counts = Counter(folded(job.path) for job in found if job.path)
    for path, count in counts.items():
        if count > 1:
            alike = [job for job in found if job.path and folded(job.path) == path]
            names = ", ".join(job.source.name for job in alike)
            raise click.UsageError(f"{names} would all be written to {alike[0].path}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """The options for all inputs; the request is for SDF unless an input has another target.

    `complete` makes a request of the options that the configuration of an input may have.
    """

    request: ConversionRequest
    complete: Callable[[RequestOptions], ConversionRequest]
    load_options: LoadOptions
    ledger: Path | None
    depfile: Path | None
    notes: bool
    every: bool
    policy: Policy
    watching: InstrumentationOptions
    gazebo_files: GazeboFiles
    audit: bool = False

    def request_for(self, job: ConversionJob) -> ConversionRequest:
        """Return the request for one input."""
        path = None if job.path is None or is_stream(job.path) else job.path
        return replace(
            self.request if path is None else self.request.beside(path),
            to=job.target,
            sdf_version=self.request.sdf_version if job.target == "sdf" else None,
            side_files=path is not None,
        )

    def for_file(self, own: ResolvedOptions) -> "Options":
        """Return the options with those of one file."""
        request = replace(self.complete(own.request), passes=own.passes or Pipeline())
        return replace(self, load_options=own.load_options, policy=own.policy, request=request)

    @property
    def beside(self) -> list[str]:
        """The paths of the files that the user's passes make, below the folder of the result."""
        return [step.only_file for step in self.request.passes if isinstance(step, FilesPass) and step.only_file]

    def places(self, job: ConversionJob, outputs: Outputs) -> Iterator[Output]:
        """Yield all files that one conversion writes.

        Raises:
            click.UsageError: a pass makes a file, and there is no folder for it.
        """
        if job.path:
            yield Output(outputs.by, job.path)
        if self.ledger:
            yield Output("--ledger", self.ledger)
        if self.depfile:
            yield Output("--depfile", self.depfile)
        yield from self.gazebo_files.places()
        beside(job.path, [step.place for step in self.request.passes if isinstance(step, FilesPass)])  # raises early
        yield from beside(job.path, self.beside)

    def show(self, source: InputSource, diagnostics: tuple[Diagnostic, ...]) -> bool:
        """Print the findings by the policy; return whether none of them is an error."""
        return show_findings(source, self.policy.apply(diagnostics), notes=self.notes, every=self.every)


def show_findings(source: InputSource, found: tuple[Diagnostic, ...], *, notes: bool, every: bool) -> bool:
    """Print the findings in a source on stderr; return whether none of them is an error."""
    if found:
        from twinform.compiler.input.finding_spans import SourceFiles  # noqa: PLC0415 - only findings have places

        files = SourceFiles({source.name: source.content} if isinstance(source.content, bytes) else {})
        show(FileFindings(source.name, found), notes=notes, on_stderr=True, every=every, files=files)
    return not any(each.is_error for each in found)


def run_job(job: ConversionJob, options: Options, label: str, outputs: Outputs) -> int:
    """Run one conversion, add its files to the outputs, and return its exit code."""
    instrumented = options.watching.begin(job.source.name)
    try:
        with mesh_progress(options.request.passes):
            conversion, updated = _convert(job, options, instrumented.instrumentation)
    except CompileError as error:
        instrumented.report()
        options.show(job.source, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        instrumented.fault(error)
        return FINDINGS
    instrumented.end()
    if not options.show(job.source, conversion.diagnostics):
        return FINDINGS
    _add(conversion, updated, job.path, options.ledger, outputs)
    if not options.gazebo_files.make(conversion, job.source.name, outputs, notes=options.notes):
        return FINDINGS
    if not options.depfile:  # build systems take what is printed for a warning
        outputs.news.append(f"{label}{': ' if label else ''}{summary(conversion.ledger)}")
    return _audit(conversion, job.source.name, outputs) if options.audit else 0


def _audit(conversion: Conversion, name: str, outputs: Outputs) -> int:
    """Account for every part of the source, independently of the conversion; return 1 if a part is missing."""
    if conversion.source is None or not conversion.text.startswith("<"):
        raise click.UsageError("--audit counts elements of XML, and this is JSON")
    from twinform.compiler.audit import audit  # noqa: PLC0415 - few conversions are counted

    found = audit(conversion.source, conversion.text, conversion.ledger)
    for part in found.unaccounted:
        print_line(f"{name}:{part.location.line}: nothing accounts for {part.text}", err=True)
        print_line(f"    at {part.location.path}", err=True)
    total = f"audit: {found.total} parts, {len(found.unaccounted)} unaccounted"
    if not found.unaccounted:
        outputs.news.append(total)
        return 0
    print_line(total, err=True)
    return FINDINGS


def _convert(
    job: ConversionJob, options: Options, instrumentation: PassInstrumentation | None
) -> tuple[Conversion, "Updated | None"]:
    """Convert, and return the updated file too if it is changed in place.

    Raises:
        CompileError: the conversion failed.
        PassError: a pass is at fault.
    """
    request, name, load_options = options.request_for(job), job.source.name, options.load_options
    if job.in_place and job.target != "json":
        from twinform.compiler.in_place import convert_in_place  # noqa: PLC0415 - most results are new files

        updated = convert_in_place(request, name, load_options, instrumentation=instrumentation)
        return updated.conversion, updated
    made = run_conversion(request, job.source.content, load_options, name=name, instrumentation=instrumentation)
    return made, None


def _add(
    conversion: Conversion, updated: "Updated | None", path: Path | None, ledger: Path | None, outputs: Outputs
) -> None:
    if path is None:
        outputs.stdout = conversion.text
    else:
        if updated is not None:
            outputs.as_read[path] = updated.source
        outputs.add(outputs.by, path, conversion.text if updated is None else updated.data)
    if ledger is not None:
        outputs.add("--ledger", ledger, conversion.ledger.to_json())
    outputs.add_beside(path, conversion.side_files)


def summary(ledger: Ledger) -> str:
    """Say how many parts were expressed, and how many met each other fate."""
    return ", ".join([f"expressed {ledger.expressed}", *(f"{fate} {ledger.count(fate)}" for fate in Fate)])


def print_plan(job: ConversionJob, options: Options, label: str) -> int:
    """Print the passes of one conversion, and return its exit code."""
    loaded = read(job.source.content, options.load_options, name=job.source.name)
    if loaded.document is None or not loaded.accepted:
        options.show(job.source, loaded.diagnostics)
        return UNUSABLE if loaded.unreadable else FINDINGS
    try:
        request = _fit(options.request_for(job), job.source, options.load_options)
    except CompileError as error:
        options.show(job.source, error.diagnostics)
        return FINDINGS
    print_line(f"{label}{': ' if label else ''}{request.plan(loaded.document)}")
    return 0


def _fit(request: ConversionRequest, source: InputSource, load_options: LoadOptions) -> ConversionRequest:
    """Add the passes for the consumers to a request, if there are any.

    Raises:
        CompileError: no passes make the source fit the consumers.
    """
    if not load_options.profiles:
        return request
    from twinform.compiler.fitting import fitted  # noqa: PLC0415 - most results are for everybody

    return fitted(request, source.content, load_options, name=source.name)


def run_into(source: InputSource, into: Path | None, base: Path | None, options: Options, outputs: Outputs) -> int:
    """Update a file of the other format with the edits of a source, and return the exit code.

    Raises:
        click.UsageError: one of the files is missing or of the wrong format.
    """
    from twinform.compiler.into import convert_into  # noqa: PLC0415 - most results are new files

    if into is None:
        raise click.UsageError("--base is for --into")
    for path in (into, *([base] if base else ())):
        if not path.is_file():
            raise click.UsageError(f"{path} is no file")
    if isinstance(source.content, bytes):
        raise click.UsageError(f"{source.name} is no file that could have been made of {into}")
    target = known_target(InputSource(str(into), str(into)).format)
    if target is None or target in {"json", source.format} or str(into).lower().endswith(XACRO):
        raise click.UsageError(f"--into takes a file of another format, URDF, SDF or MJCF, which {into} is not")
    request = options.request_for(ConversionJob(source, target, into))
    try:
        updated = convert_into(request, Path(source.name), into, options.load_options, base=base)
    except CompileError as error:
        options.show(source, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    if not options.show(source, updated.conversion.diagnostics):
        return FINDINGS
    outputs.add("--into", into, updated.data)
    outputs.as_read[into] = updated.source
    outputs.add_beside(into, updated.conversion.side_files)
    outputs.news.extend(describe_change(into, change) for change in updated.changes)
    changes = len(updated.changes)
    outputs.news.append(f"{into}: {plural(changes, 'change')}" if changes else f"{into} stays as it is")
    return 0


def describe_change(path: Path, change: "TextChange") -> str:
    """Say where a file was changed, and what: no edit of a person goes away unmentioned."""
    line, column = change.place
    old, new = _shorten(change.old), _shorten(change.new)
    what = f"{old} becomes {new}" if old and new else f"{old} is deleted" if old else f"{new} is inserted"
    return f"{path}:{line}:{column}: {what}"


def _shorten(piece: str) -> str:
    """Write a piece of a file in one line, cut if it is long."""
    return cut(printable(" ".join(piece.split())))


def run_split(source: InputSource, to: Target, options: Options, folder: Path, outputs: Outputs) -> int:
    """Split a world into files of a folder, and return the exit code; an error in one of them stops all.

    To URDF, a model becomes URDF if Gazebo reads that as the same robot, and else stays SDF.
    """
    from twinform.compiler import split  # noqa: PLC0415 - few worlds are split

    instrumented = options.watching.begin(source.name)
    try:
        request = replace(options.request, to=to)
        result = split(
            request,
            source.content,
            options.load_options,
            name=source.name,
            instrumentation=instrumented.instrumentation,
            folder=folder,
        )
    except CompileError as error:
        instrumented.report()
        options.show(source, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        instrumented.fault(error)
        return FINDINGS
    instrumented.end()
    if not options.show(source, result.diagnostics):
        return FINDINGS
    _add_files(result, folder, options.ledger, outputs)
    if len(result.files) == 1:
        outputs.news.append(
            "the file has no model of its own; --expand-includes also writes the models that it includes"
        )
    outputs.news.append(f"{plural(len(result.files), 'file')}: {summary(result.ledger)}")
    return 0


def _add_files(result: "SplitWorld", folder: Path, ledger: Path | None, outputs: Outputs) -> None:
    for name, text in result.files.items():
        outputs.add("--split", folder / name, text)
    if ledger is not None:
        outputs.add("--ledger", ledger, result.ledger.to_json())
    outputs.add_beside(folder / next(iter(result.files)), result.side_files)
