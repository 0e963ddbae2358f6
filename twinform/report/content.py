"""The content of a report on one file or two, from the modules of the compiler that know each part."""

from collections.abc import Callable
from dataclasses import field, replace
from pathlib import Path, PurePath

from twinform.compiler.compare import USUAL, Comparison, ComparisonOptions, compare_files
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.expand_includes import expand
from twinform.compiler.graph import Graph, build_graph
from twinform.compiler.input.finding_spans import SourceFiles, with_columns
from twinform.compiler.input.load_options import name_of_input
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, read
from twinform.compiler.inspection import inspect
from twinform.compiler.request import ConversionRequest
from twinform.compiler.resolve_uris import SearchPath
from twinform.compiler.scene import Scene, build_scene
from twinform.compiler.statistics import FileStatistics, MeshCost, ModelStatistics, measure
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Ledger, Severity
from twinform.diagnostics.diagnostic import WORST_FIRST
from twinform.diagnostics.reporters import FileFindings
from twinform.ir import Document, Format
from twinform.passes import PassError
from twinform.report.markup import count
from twinform.report.relative_paths import Shorten, relative_to_here, with_relative_paths
from twinform.view import NotDrawn, StandaloneView, ViewerMissingError, ViewError, standalone_view

View = Callable[[Document, Document | None, Comparison | None, SearchPath], StandaloneView]
"""Makes the page of the 3D view."""
_NO_VIEW = StandaloneView("")


@dataclass(frozen=True, slots=True)
class ReportSubject:
    """One file; if it has errors, there may be no document, and there are no numbers."""

    name: str
    loaded: LoadResult
    findings: FileFindings
    document: Document | None = None
    statistics: FileStatistics | None = None
    scene: Scene | None = None
    graph: Graph | None = None

    @property
    def title(self) -> str:
        """The name of the model or world, or else of the file."""
        return (self.graph.title if self.graph else "") or Path(self.name).name

    @property
    def models(self) -> tuple[ModelStatistics, ...]:
        """The numbers of every model, those in worlds first; none if the file has errors."""
        found = self.statistics
        return (*(model for world in found.worlds for model in world.models), *found.models) if found else ()

    @property
    def meshes(self) -> tuple[MeshCost, ...]:
        """The mesh files of all models, without duplicates."""
        return tuple({each.uri: each for model in self.models for each in model.meshes}.values())

    def count(self, severity: Severity) -> int:
        """Count the findings of a severity."""
        return sum(each.severity is severity for each in self.findings.diagnostics)

    @property
    def counts(self) -> str:
        """How many errors, warnings and notes there are, in words."""
        return ", ".join(count(self.count(each), each.word) for each in WORST_FIRST)


@dataclass(frozen=True, slots=True)
class Converted:
    """The ledger of converting a file into the other format, or the reasons why it cannot be converted."""

    target: Format
    ledger: Ledger | None = None
    reasons: tuple[Diagnostic, ...] = ()


@dataclass(frozen=True, slots=True)
class ModelReport:
    """The whole report; `view` is a page. `without_...` is the reason why there is no view or comparison."""

    first: ReportSubject
    second: ReportSubject | None = None
    comparison: Comparison | None = None
    without_comparison: str = ""
    converted: Converted | None = None
    view: str = field(default="", repr=False)
    not_drawn: tuple[NotDrawn, ...] = ()
    without_view: str = ""

    @property
    def subjects(self) -> tuple[ReportSubject, ...]:
        """The first file, and the second if there is one."""
        return (self.first,) if self.second is None else (self.first, self.second)

    @property
    def files(self) -> tuple[str, ...]:
        """The names of the files, with as many of their folders as tell two apart; A and B where nothing does."""
        return _tell_apart([PurePath(each.name) for each in self.subjects])

    @property
    def robots(self) -> tuple[str, ...]:
        """The name of the robot or world in each file, and the file."""
        named = zip(self.subjects, self.files, strict=True)
        return tuple(file if each.title == file else f"{each.title} ({file})" for each, file in named)

    @property
    def title(self) -> str:
        """What the report is about."""
        return " compared with ".join(self.robots)

    @property
    def unreadable(self) -> bool:
        """Whether one of the files cannot be read."""
        return any(each.loaded.unreadable for each in self.subjects)

    @property
    def accepted(self) -> bool:
        """Whether no file has an error."""
        return all(each.loaded.accepted for each in self.subjects)


def _tell_apart(paths: list[PurePath]) -> tuple[str, ...]:
    for length in range(1, max(len(each.parts) for each in paths) + 1):
        names = tuple(str(PurePath(*each.parts[-length:])) for each in paths)
        if len({*names}) == len(paths):
            return names
    return tuple("AB"[: len(paths)])


def make_page(
    first: Document, second: Document | None, comparison: Comparison | None, search: SearchPath
) -> StandaloneView:
    """Make the page of the 3D view with `twinform.view`."""
    return standalone_view(first, second, comparison, search=search)


def build_report(
    first: Input,
    second: Input | None = None,
    load_options: LoadOptions | None = None,
    *,
    names: tuple[str, str] = ("", ""),
    model: str | None = None,
    options: ComparisonOptions = USUAL,
    meshes: bool = True,
    view: View | None = make_page,
) -> ModelReport:
    """Report on a file or document, and on how it differs from a second one.

    Paths are relative to the working directory: a report is for others, and names no folder of this machine.

    Args:
        first: the file or document.
        second: another one to compare it with.
        load_options: how files are read.
        names: what the files are called, by default their paths; meshes for the view are looked for beside them.
        model: the name of the model to convert and compare, if there are several.
        options: how robots are compared.
        meshes: whether mesh files are read for numbers.
        view: makes the page of the 3D view; None for a report without one.

    Raises:
        CompileError: a file could be read at first, and then not.
    """
    load_options = load_options or LoadOptions()
    one = _examine(first, names[0], load_options, meshes=meshes)
    two = None if second is None else _examine(second, names[1], load_options, meshes=meshes)
    comparison, problem = None, ""
    if second is not None and two is not None:
        try:
            comparison = compare_files(first, second, load_options, options, names=(one.name, two.name), model=model)
        except CompileError as error:
            if error.unreadable and not (one.loaded.unreadable or two.loaded.unreadable):
                raise
            problem = str(error)
    converted = _convert(first, one, load_options, model)
    made, reason = _make_view(one, two, comparison, load_options.search, view)
    report = ModelReport(one, two, comparison, problem, converted, made.page, made.not_drawn, reason)
    return _with_relative_paths(report, relative_to_here((each.name for each in report.subjects), load_options.search))


def _with_relative_paths(report: ModelReport, shorten: Shorten) -> ModelReport:
    first, second = (
        each
        and replace(
            each,
            name=shorten(each.name),
            findings=with_relative_paths(each.findings, shorten),
            statistics=with_relative_paths(each.statistics, shorten),
        )
        for each in (report.first, report.second)
    )
    return replace(
        report,
        first=first,
        second=second,
        comparison=with_relative_paths(report.comparison, shorten),
        without_comparison=shorten(report.without_comparison),
        converted=with_relative_paths(report.converted, shorten),
        not_drawn=with_relative_paths(report.not_drawn, shorten),
        without_view=shorten(report.without_view),
    )


def _examine(source: Input, name: str, load_options: LoadOptions, *, meshes: bool) -> ReportSubject:
    """Find out everything about one file, with its includes expanded."""
    loaded = inspect(expand(read(source, load_options, name=name), load_options), load_options)
    files, name = SourceFiles.of(loaded), name or name_of_input(source)
    findings = FileFindings(loaded.path, with_columns(loaded.diagnostics, files), files)
    document = loaded.document
    if document is None:
        return ReportSubject(name, loaded, findings)
    numbers = measure(loaded, document, load_options.search, meshes=meshes) if loaded.accepted else None
    scene = build_scene(document) if loaded.accepted else None
    graph = build_graph(document, mimics=True)
    return ReportSubject(name, loaded, findings, document, numbers, scene, graph)


def _convert(source: Input, subject: ReportSubject, load_options: LoadOptions, model: str | None) -> Converted | None:
    if subject.document is None or not subject.loaded.accepted:
        return None
    target = subject.document.format.counterpart
    request = ConversionRequest(to=target.value, model=model)
    try:
        return Converted(target, run_conversion(request, source, load_options, name=subject.name).ledger)
    except CompileError as error:
        if error.unreadable and not subject.loaded.unreadable:
            raise
        return Converted(target, reasons=tuple(each for each in error.diagnostics if each.is_error))


def _make_view(
    one: ReportSubject, two: ReportSubject | None, comparison: Comparison | None, search: SearchPath, view: View | None
) -> tuple[StandaloneView, str]:
    if view is None:
        return _NO_VIEW, "it was not asked for"
    if one.document is None or not one.loaded.accepted:
        return _NO_VIEW, "the file has errors"
    other = two.document if two and two.loaded.accepted else None
    try:
        return view(one.document, other, comparison, search), ""
    except ViewerMissingError as error:
        # the page is for others: it names no folder of this machine
        return _NO_VIEW, f"the 3D view needs {error.library}: pip install 'twinform[view]'"
    except (ViewError, PassError) as error:
        return _NO_VIEW, str(error)
