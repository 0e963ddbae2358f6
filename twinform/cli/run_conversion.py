"""One conversion, as the command line asks for it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from twinform.cli.conversion_targets import ConversionJob
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.gazebo_files import GazeboFiles
from twinform.cli.instrumentation import InstrumentationOptions
from twinform.cli.mesh_progress import mesh_progress
from twinform.cli.outputs import Output, Outputs, beside
from twinform.cli.own_options import ResolvedOptions
from twinform.cli.print_findings import show
from twinform.cli.printing import print_line
from twinform.cli.source import InputSource
from twinform.compiler import CompileError, Conversion, ConversionRequest, LoadOptions, read, run_conversion
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy
from twinform.diagnostics.reporters import FileFindings
from twinform.passes import FilesPass, PassError, PassInstrumentation, Pipeline, SideFilePass

if TYPE_CHECKING:
    from twinform.compiler.input.source_files import SourceFiles

if TYPE_CHECKING:
    from twinform.compiler.in_place import Updated


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What is the same for every input; the order is for SDF unless an input's target is another one."""

    request: ConversionRequest
    load_options: LoadOptions
    ledger: Path | None
    notes: bool
    every: bool
    policy: Policy
    watching: InstrumentationOptions
    gazebo_files: GazeboFiles
    audit: bool = False

    def request_for(self, job: ConversionJob) -> ConversionRequest:
        """What one input is to become."""
        return replace(
            self.request, to=job.target, sdf_version=self.request.sdf_version if job.target == "sdf" else None
        )

    def for_file(self, own: ResolvedOptions) -> "Options":
        """Return the options with a file's own settings in place of the shared ones."""
        request = replace(self.request, passes=own.passes or Pipeline())
        return replace(self, load_options=own.load_options, policy=own.policy, request=request)

    @property
    def beside(self) -> list[str]:
        """The files that the user's passes make, by their paths below the folder of the result."""
        return [step.file for step in self.request.passes if isinstance(step, SideFilePass)]

    def places(self, job: ConversionJob, outputs: Outputs) -> Iterator[Output]:
        """All that one conversion writes.

        Raises:
            click.UsageError: a pass makes a file, and there is no folder for it.
        """
        if job.path:
            yield Output(outputs.by, job.path)
        if self.ledger:
            yield Output("--ledger", self.ledger)
        yield from self.gazebo_files.places()
        beside(job.path, [step.place for step in self.request.passes if isinstance(step, FilesPass)])  # raises early
        yield from beside(job.path, self.beside)

    def show(self, source: InputSource, diagnostics: tuple[Diagnostic, ...]) -> bool:
        """Print the findings as the project wants to see them; whether none of them is an error."""
        seen = self.policy.apply(diagnostics)
        files = _files(source) if seen else None
        show(FileFindings(source.name, seen), notes=self.notes, on_stderr=True, every=self.every, files=files)
        return not any(each.is_error for each in seen)


def _files(source: InputSource) -> "SourceFiles":
    from twinform.compiler.input.source_files import SourceFiles  # noqa: PLC0415 - only findings have places

    return SourceFiles({source.name: source.content}) if isinstance(source.content, bytes) else SourceFiles()


def run_job(job: ConversionJob, options: Options, label: str, outputs: Outputs) -> int:
    """Run one conversion, and add what it makes to what is written; gives its exit code."""
    instrumented = options.watching.begin(job.source.name)
    try:
        with mesh_progress(options.request.passes):
            conversion, updated = _converted(job, options, instrumented.instrumentation)
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
    outputs.news.append(f"{label}{': ' if label else ''}{summary(conversion.ledger)}")
    return _audit(conversion, job.source.name, outputs) if options.audit else 0


def _audit(conversion: Conversion, name: str, outputs: Outputs) -> int:
    """Count what became of every part, by an instrument that knows nothing of the conversion; 1 if any is missing."""
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


def _converted(
    job: ConversionJob, options: Options, instrumentation: PassInstrumentation | None
) -> tuple[Conversion, "Updated | None"]:
    """The conversion and, where it is one in place, the file with what it changes.

    Raises:
        CompileError: it failed.
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
    """How much was expressed, and how much met each other fate."""
    return ", ".join([f"expressed {ledger.expressed}", *(f"{fate} {ledger.count(fate)}" for fate in Fate)])


def print_plan(job: ConversionJob, options: Options, label: str) -> int:
    """Print the passes of one conversion; gives its exit code."""
    loaded = read(job.source.content, options.load_options, name=job.source.name)
    if loaded.document is None or not loaded.accepted:
        options.show(job.source, loaded.diagnostics)
        return UNUSABLE if loaded.unreadable else FINDINGS
    try:
        request = _fitted(options.request_for(job), job.source, options.load_options)
    except CompileError as error:
        options.show(job.source, error.diagnostics)
        return FINDINGS
    print_line(f"{label}{': ' if label else ''}{request.plan(loaded.document)}")
    return 0


def _fitted(request: ConversionRequest, source: InputSource, load_options: LoadOptions) -> ConversionRequest:
    """The request with the passes for the consumers, if there are any.

    Raises:
        CompileError: the source cannot be made what they take.
    """
    if not load_options.profiles:
        return request
    from twinform.compiler.fitting import fitted  # noqa: PLC0415 - most results are for everybody

    return fitted(request, source.content, load_options, name=source.name)
