"""What a batch does with each model: convert, check, compare or measure it.

The files of a model folder of Gazebo come with the newest model that its model.config names: meshes, textures and all
others, without hidden files, other models, and links that lead elsewhere. The copied model.config names the results.
"""

import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import asdict, field, replace
from pathlib import Path, PurePosixPath

from lxml import etree

from twinform.compiler.batch.entries import LEDGER, PATTERNS, stem
from twinform.compiler.batch.record import Outcome, Row
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.compare import USUAL, ComparisonOptions, compare_files
from twinform.compiler.compare.comparison_reporters import REPORTERS, summary
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.expand_includes import expand
from twinform.compiler.input.finding_spans import SourceFiles, with_columns
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.loading import LoadResult, read
from twinform.compiler.inspection import as_refused, inspect
from twinform.compiler.model_config import MANIFESTS, manifest, model_file
from twinform.compiler.request import ConversionRequest
from twinform.compiler.split_world import split
from twinform.compiler.statistics import measure
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Fate, Ledger, Policy, Severity, SideFile
from twinform.diagnostics.reporters.json import row
from twinform.file_access import Readable
from twinform.passes import FilesPass, Pipeline


@dataclass(frozen=True, slots=True, kw_only=True)
class Convert:
    """Convert a model.

    With `split` a world becomes a folder of files, with `ledgers` each result has a ledger beside it, and with
    `model_folders` the other files in the folder of a model are copied along.
    """

    to: ConversionRequest
    policy: Policy = field(default_factory=Policy)
    split: bool = False
    ledgers: bool = False
    model_folders: bool = False

    def work(self, task: Task, content: bytes) -> Done:
        """Convert the model."""
        name = str(task.path)
        texts: dict[str, str | bytes]
        try:
            if self.split and _is_world(task):
                made_of_world, found, ledger = self._split(task)
                texts = dict(made_of_world)
            else:
                source = task.path if task.path.name.lower().endswith(XACRO) or task.load_options.xacro else content
                made = run_conversion(_separate_mesh_files(self.to, task.output), source, task.load_options, name=name)
                texts = {task.output: made.text, **_place_beside(PurePosixPath(task.output).parent, made.side_files)}
                found, ledger = made.diagnostics, made.ledger
                if self.model_folders:
                    texts |= folder_files(task.path, task.output, self.to, made.document.version)
        except CompileError as error:
            return _refuse(error, self.policy, name)
        except FolderTooLargeError as error:
            return Done(outcome=Outcome.UNWRITTEN, message=str(error))
        seen = self.policy.apply(found)
        if any(each.is_error for each in seen):
            return _refuse(CompileError(seen), Policy(), name)
        if self.ledgers:
            texts[task.output + LEDGER] = ledger.to_json()
        return Done(
            outcome=Outcome.CONVERTED,
            texts=texts,
            diagnostics=_report_findings(seen, name),
            ledger={"expressed": ledger.expressed, **{str(fate): ledger.count(fate) for fate in Fate}},
        )

    def _split(self, task: Task) -> tuple[dict[str, str | bytes], tuple[Diagnostic, ...], Ledger]:
        folder = PurePosixPath(stem(task.entry.name))
        made = split(
            self.to,
            task.path,
            task.load_options,
            name=str(task.path),
            folder=Path(task.dest, folder) if task.dest else None,
        )
        texts: dict[str, str | bytes] = {str(folder / name): text for name, text in made.files.items()}
        texts |= _place_beside((folder / next(iter(made.files))).parent, made.side_files)
        return texts, made.diagnostics, made.ledger


def _separate_mesh_files(request: ConversionRequest, output: str) -> ConversionRequest:
    """Return the request with a folder of its own for the mesh files that passes write for this model."""
    if not any(isinstance(step, FilesPass) for step in request.passes):
        return request
    own = PurePosixPath(output).name.partition(".")[0] or "model"
    steps = (step.below(own) if isinstance(step, FilesPass) else step for step in request.passes)
    return replace(request, passes=Pipeline(tuple(steps)))


def _place_beside(folder: PurePosixPath, files: Iterable[SideFile]) -> dict[str, str | bytes]:
    return {str(folder / each.path): each.content for each in files}


def _is_world(task: Task) -> bool:
    """Return whether a file holds a world; one with errors is left to the conversion, which reports them."""
    loaded = _load(task)
    return loaded.accepted and loaded.document is not None and bool(loaded.document.worlds)


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """Find everything that is wrong with a model, as `twinform check` does."""

    policy: Policy = field(default_factory=Policy)
    passes: Pipeline = field(default_factory=Pipeline)
    expand_includes: bool = False

    def work(self, task: Task, content: bytes) -> Done:
        """Check the model."""
        del content  # it is read by its path
        name, loaded = str(task.path), _load(task, expand_includes=self.expand_includes)
        seen = self.policy.apply(as_refused(inspect(loaded, task.load_options, self.passes)).diagnostics)
        seen = with_columns(seen, SourceFiles.of(loaded)) if seen else seen
        if loaded.unreadable or any(each.is_error for each in seen):
            return _refuse(CompileError(seen, unreadable=loaded.unreadable), Policy(), name)
        return Done(outcome=Outcome.ACCEPTED, diagnostics=_report_findings(seen, name))


@dataclass(frozen=True, slots=True, kw_only=True)
class Diff:
    """Compare a model with the one of the same name in the folder `other`, as `twinform diff` does."""

    other: Path
    options: ComparisonOptions = USUAL

    def work(self, task: Task, content: bytes) -> Done:
        """Compare the model with the one of its name."""
        del content  # it is read by its path
        a, b = task.path, self.other / task.entry.other
        try:
            found = compare_files(a, b, task.load_options, self.options, names=(str(a), str(b)))
        except CompileError as error:
            return _refuse(error, Policy(), str(a))
        outcome = Outcome.SAME if found.same else Outcome.DIFFERENT
        details = {"comparison": json.loads(REPORTERS["json"](found))}
        return Done(outcome=outcome, message="" if found.same else summary(found), details=details)


@dataclass(frozen=True, slots=True, kw_only=True)
class Stats:
    """Count what a model is made of, as `twinform stats` does; with `meshes` the cost of its meshes too."""

    meshes: bool = True
    expand_includes: bool = False

    def work(self, task: Task, content: bytes) -> Done:
        """Measure the model."""
        del content  # it is read by its path
        name, loaded = str(task.path), _load(task, expand_includes=self.expand_includes)
        if loaded.document is None or not loaded.accepted:
            return _refuse(CompileError(loaded.diagnostics, unreadable=loaded.unreadable), Policy(), name)
        found = measure(loaded, loaded.document, task.load_options.search, meshes=self.meshes)
        return Done(outcome=Outcome.MEASURED, details={"statistics": asdict(found)})


def _load(task: Task, *, expand_includes: bool = False) -> LoadResult:
    loaded = read(task.path, task.load_options, name=str(task.path))
    return expand(loaded, task.load_options) if expand_includes else loaded


def _report_findings(diagnostics: Iterable[Diagnostic], name: str) -> list[Row]:
    """Return findings about a file as rows of the report, without notes."""
    return [row(each, name) for each in diagnostics if each.severity > Severity.INFO]


def _refuse(error: CompileError, policy: Policy, name: str) -> Done:
    """Return the result for a model that cannot be read or has errors."""
    outcome = Outcome.UNREADABLE if error.unreadable else Outcome.REFUSED
    found = _report_findings(policy.apply(error.diagnostics), name)
    return Done(outcome=outcome, message=str(error), diagnostics=found)


_LARGEST = 2**28
"""Bytes of all files that are copied along with a model."""


class FolderTooLargeError(Exception):
    """The files beside a model are too large."""


def folder_files(model: Path, output: str, request: ConversionRequest, version: str | None) -> dict[str, bytes]:
    """Return the files to copy along with a model, by their paths among the results; none if it has no model folder.

    `output` is the path of the model among the results, and `version` its SDF version there.

    Raises:
        FolderTooLargeError: there is too much.
        OSError: a file cannot be read.
    """
    config = manifest(model.parent)
    if config is None or not _is_named(config, model):
        return {}
    place = PurePosixPath(output).parent
    files: dict[str, bytes] = {}
    size, readable = 0, Readable.of(model)
    for path in _find_files(model.parent):
        data = readable.read(path, _LARGEST)
        size += len(data)
        if size > _LARGEST:
            raise FolderTooLargeError(f"what lies beside it is larger than {_LARGEST >> 20} MiB")
        files[str(place / path.relative_to(model.parent).as_posix())] = data
    files[str(place / config.name)] = _adapt_config(config, PurePosixPath(output).name, model.name, request, version)
    return files


def _is_named(config: Path, model: Path) -> bool:
    """Return whether a model.config names this model as the newest one."""
    named = model_file(config, None, DiagnosticSink())
    # One of the versions has to bring the rest along, so that no two results have one place: the
    # one that a reader would take.
    return named is not None and named.resolve() == model.resolve()


def _find_files(folder: Path) -> Iterator[Path]:
    """Yield the files of a folder, sorted, without models and model folders in it."""
    readable = Readable((os.path.realpath(folder),))
    for place, folders, files in os.walk(folder):
        here = Path(place)
        folders[:] = sorted(name for name in folders if not name.startswith(".") and manifest(here / name) is None)
        for name in sorted(files):
            path = here / name
            is_model = any(path.match(pattern) for pattern in PATTERNS)
            if is_model or name.startswith(".") or (here == folder and name in MANIFESTS):
                continue
            if path.is_file() and readable.allows(path):
                yield path


def _adapt_config(config: Path, output: str, model: str, request: ConversionRequest, version: str | None) -> bytes:
    """Return the model.config with the names of results; only the newest model if all get the same SDF version."""
    data = Readable.of(config).read(config)
    try:
        tree = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True)).getroottree()
    except etree.XMLSyntaxError:
        return data
    for named in list(tree.getroot().iterchildren("sdf")):
        name = PurePosixPath((named.text or "").strip())
        if name.name == model:
            named.text = output
            if request.to == "sdf" and version:
                named.set("version", version)
        elif request.to == "sdf" and request.sdf_version is not None:
            tree.getroot().remove(named)
        elif name.suffix.lower() in {".sdf", ".urdf"}:
            named.text = f"{stem(str(name))}.{request.to}"
    return etree.tostring(tree, xml_declaration=True, encoding="UTF-8") + b"\n"
