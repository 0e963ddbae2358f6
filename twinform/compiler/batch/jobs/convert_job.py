"""Converts each model of a batch, and splits worlds if that is asked for."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path, PurePosixPath

from twinform.compiler.batch.entries import stem
from twinform.compiler.batch.jobs.finding_rows import refused, rows
from twinform.compiler.batch.model_folders import FolderTooLargeError, folder_files
from twinform.compiler.batch.places import LEDGER
from twinform.compiler.batch.record import Outcome
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.loading import XACRO, read
from twinform.compiler.request import ConversionRequest
from twinform.compiler.splitting import split
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy, SideFile
from twinform.passes import FilesPass, Pipeline, registered_passes


@dataclass(frozen=True, slots=True, kw_only=True)
class Convert:
    """Compile a model; with `split` a world into a folder of files, and with `ledgers` a ledger beside each result.

    With `model_folders`, what lies in the folder of a model comes along.
    """

    to: ConversionRequest
    policy: Policy = field(default_factory=Policy)
    split: bool = False
    ledgers: bool = False
    model_folders: bool = False

    @property
    def request(self) -> list[object]:
        """The options that the outcome depends on."""
        to = self.to
        asked: list[object] = [to.to, to.sdf_version, to.urdf_version, to.carriers, str(to.passes), to.expand_includes]
        asked += [to.comments, to.keep_physics, self.split, self.ledgers]
        asked += [sorted(self.policy.allow), sorted(self.policy.deny)]
        asked += ["model folders"] if self.model_folders else []
        return ["convert", *asked, sorted(_packages(to))]

    def work(self, task: Task, content: bytes) -> Done:
        """Convert it."""
        name = str(task.path)
        texts: dict[str, str | bytes]
        try:
            if self.split and _is_world(task):
                made_of_world, found, ledger = self._split(task)
                texts = dict(made_of_world)
            else:
                source = task.path if task.path.suffix.lower() == XACRO or task.load_options.xacro else content
                made = run_conversion(_with_own_folder(self.to, task.output), source, task.load_options, name=name)
                texts = {task.output: made.text, **_beside(PurePosixPath(task.output).parent, made.side_files)}
                found, ledger = made.diagnostics, made.ledger
                if self.model_folders:
                    texts |= folder_files(task.path, task.output, self.to, made.document.version)
        except CompileError as error:
            return refused(error, self.policy, name)
        except FolderTooLargeError as error:
            return Done(outcome=Outcome.UNWRITTEN, message=str(error))
        seen = self.policy.apply(found)
        if any(each.is_error for each in seen):
            return Done(outcome=Outcome.REFUSED, message=str(CompileError(seen)), diagnostics=rows(seen, name))
        if self.ledgers:
            texts[task.output + LEDGER] = ledger.to_json()
        return Done(outcome=Outcome.CONVERTED, texts=texts, diagnostics=rows(seen, name), ledger=_counts(ledger))

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
        texts |= _beside((folder / next(iter(made.files))).parent, made.side_files)
        return texts, made.diagnostics, made.ledger


def _with_own_folder(request: ConversionRequest, output: str) -> ConversionRequest:
    """Return the request with a folder of its own for the files that passes make of this model's meshes."""
    if not any(isinstance(step, FilesPass) for step in request.passes):
        return request
    own = PurePosixPath(output).name.partition(".")[0] or "model"
    steps = (step.below(own) if isinstance(step, FilesPass) else step for step in request.passes)
    return replace(request, passes=Pipeline(tuple(steps)))


def _beside(folder: PurePosixPath, files: Iterable[SideFile]) -> dict[str, str | bytes]:
    return {str(folder / each.path): each.content for each in files}


def _is_world(task: Task) -> bool:
    """Whether a file holds a world; one with errors is left to the conversion, which reports them."""
    loaded = read(task.path, task.load_options, name=str(task.path))
    return loaded.accepted and loaded.document is not None and bool(loaded.document.worlds)


def _packages(to: ConversionRequest) -> set[str]:
    """The packages that bring the passes, in their versions."""
    owners = {registered_passes()[step.name].owner for step in to.passes if step.name in registered_passes()}
    return {f"{owner} {version(owner)}" for owner in owners if owner}


def _counts(ledger: Ledger) -> dict[str, int]:
    return {"expressed": ledger.expressed, **{str(fate): ledger.count(fate) for fate in Fate}}
