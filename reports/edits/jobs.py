"""One model, converted, edited many times and converted on: what a worker process of the report does."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from random import Random
from typing import Literal

import twinform
from reports.edits import passes as edit_passes
from reports.harness import files
from reports.harness.files import kept
from tests.corpus.examine import rules_of
from tests.corpus.files import CORPUS, CorpusFile, Kind, models
from tests.corpus.there_and_back import robots
from twinform.testing.edits import Edit, apply_all, draw_edits
from twinform.testing.edits.judging import Converted, Outcome, Verdict, judge, judge_edits, unedited
from twinform.testing.edits.mistakes import KIND as MISTAKE
from twinform.testing.edits.plainly import Plainly

OUT = files.OUT / "edits"
MOST_BYTES = 400_000
"""Converted files that are larger are not edited: it would take longer than all others together."""
SEVERAL = "two or three of these"
PASS = "pass: "
NO_WAY_HOME = "no way home without an edit"
_USUAL_BYTES = 60_000
_PLAINLY = {"attach": Plainly.NONE}
"""The other model that is attached has carriers of its own."""
_VERSIONS = ("1.11",) * 7 + ("1.9", "1.8", "1.6")
_ONE_IN = 20
"""So many of the edits that won are shown to Drake."""


class Way:
    """The ways that are tried."""

    TO_SDF = "URDF -> SDF, edited -> URDF"
    TO_URDF = "SDF -> URDF, edited -> SDF"


@dataclass(frozen=True, slots=True)
class Job:
    """A model: a file of the corpus, or of `out/edits`; `edits` of it are tried, and some of the passes."""

    name: str
    path: Path
    paths: tuple[Path, ...]
    is_urdf: bool
    seed: int
    edits: int
    passes: int = 2
    only_passes: tuple[str, ...] = ()
    replay: str = ""


@dataclass(frozen=True, slots=True)
class Tried:
    """One edit of one converted model, or one pass; `replay` says it again, `folder` has the files of a fault."""

    name: str
    way: str
    kind: str
    verdict: Verdict
    replay: str = ""
    folder: str = ""
    pair: tuple[Path, Path] | None = None


@dataclass(frozen=True, slots=True)
class Done:
    """All that was tried on a model; `left_out` says why nothing was, `differing` what differs without an edit."""

    name: str
    left_out: str = ""
    differing: tuple[str, ...] = ()
    tried: tuple[Tried, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class _Model:
    """A model on the other side."""

    job: Job
    robot: str | None
    version: str | None
    before: Converted

    @property
    def name(self) -> str:
        return " ".join(filter(None, (self.job.name, self.robot, self.version)))

    @property
    def way(self) -> str:
        return Way.TO_SDF if self.job.is_urdf else Way.TO_URDF

    def replay(self, what: str) -> str:
        return json.dumps([self.job.name, self.robot, self.version, what], ensure_ascii=False)


def corpus_jobs(seed: int, edits: dict[bool, int]) -> Iterator[Job]:
    """A job for each model file of the corpus; `edits` is how many for URDF, and for SDF."""
    return (corpus_job(file, seed, edits[file.kind is Kind.URDF]) for file in models())


def corpus_job(file: CorpusFile, seed: int, edits: int) -> Job:
    """The job of one file."""
    return Job(file.name, file.path, file.paths, file.kind is Kind.URDF, seed, edits)


def work(job: Job) -> list[Done]:
    """Convert the robots of a file, and try edits and passes on each."""
    random = Random(f"{job.seed} {job.name}")
    try:
        checked = twinform.check(job.path, paths=job.paths)
    except Exception as error:  # noqa: BLE001 - that is the business of the report on the corpus
        return [Done(job.name, f"not read: {type(error).__name__}")]
    if checked.document is None or not checked.accepted:
        return []
    among = robots(checked.document)
    return [_worked(job, robot, max(1, job.edits // len(among)), random) for robot in among]


def _worked(job: Job, robot: str | None, edits: int, random: Random) -> Done:
    version = random.choice(_VERSIONS) if job.is_urdf else None
    name = " ".join(filter(None, (job.name, robot, version)))
    model = converted(job, robot, version)
    if isinstance(model, str):
        return Done(name, model, tried=_lost(job, robot, version, model))
    count = edits if len(model.before.text) < _USUAL_BYTES else max(1, edits // 4)
    tried = [*_edits(model, count, random), *_passes(model, random)]
    differing = tuple(sorted(": ".join(filter(None, key)) for key in model.before.differing))
    return Done(name, "", differing, tuple(tried))


def _lost(job: Job, robot: str | None, version: str | None, why: str) -> tuple[Tried, ...]:
    """The fault of a model that is converted, and cannot be converted back."""
    if not why.startswith(NO_WAY_HOME):
        return ()
    way = Way.TO_SDF if job.is_urdf else Way.TO_URDF
    replay = json.dumps([job.name, robot, version, "[]"], ensure_ascii=False)
    return (Tried(job.name, way, NO_WAY_HOME, Verdict(Outcome.SILENT, (why,)), replay),)


def converted(job: Job, robot: str | None, version: str | None) -> _Model | str:
    """A model on the other side, and what differs before any edit; or why there is none."""
    target: Literal["sdf", "urdf"] = "sdf" if job.is_urdf else "urdf"
    try:
        made = twinform.convert(job.path, to=target, sdf_version=version, model=robot, paths=job.paths)
        text = made.text.encode()
    except twinform.CompileError as error:
        return f"not converted: {', '.join(rules_of(error.diagnostics))}"
    if len(text) > MOST_BYTES:
        return f"too large: {len(text) // 1000} kB"
    try:
        return _Model(job, robot, version, unedited(text))
    except Exception as error:  # noqa: BLE001 - whatever it is, what was converted has a way home
        rules = rules_of(error.diagnostics) if isinstance(error, twinform.CompileError) else (str(error),)
        return f"{NO_WAY_HOME}: {type(error).__name__}: {', '.join(rules)}"


def again(model: _Model, what: str) -> tuple[bytes, Tried]:
    """The edit or pass of a replay."""
    if what.startswith(PASS):
        pipeline = what.removeprefix(PASS)
        return _passed(model, pipeline.partition("{")[0], pipeline)
    edits = tuple(Edit.from_text(json.dumps(each)) for each in json.loads(what))
    return _edited(model, edits, apply_all(edits, model.before.text))


def _edits(model: _Model, count: int, random: Random) -> Iterator[Tried]:
    for _ in range(count):
        edits, text = draw_edits(model.before.text, random)
        _, tried = _edited(model, edits, text)
        yield _kept(model, text, tried, random)


def _edited(model: _Model, edits: tuple[Edit, ...], text: bytes) -> tuple[bytes, Tried]:
    verdict = judge_edits(model.before, edits, text)
    is_mistake = any(each.kind == MISTAKE for each in edits)
    kind = edits[0].kind if len(edits) == 1 else MISTAKE if is_mistake else SEVERAL
    said = "[" + ", ".join(map(str, edits)) + "]"
    return text, Tried(model.name, model.way, kind, verdict, model.replay(said))


def _passes(model: _Model, random: Random) -> Iterator[Tried]:
    job = model.job
    names = job.only_passes or random.sample(edit_passes.NAMES, job.passes)
    for name in names:
        pipeline = edit_passes.pipeline(name, model.before.text, random)
        if pipeline is None:
            continue
        text, tried = _passed(model, name, pipeline)
        yield _kept(model, text, tried, random)


def _passed(model: _Model, name: str, pipeline: str) -> tuple[bytes, Tried]:
    same: Literal["sdf", "urdf"] = "urdf" if model.before.to == "sdf" else "sdf"
    replay, kind = model.replay(PASS + pipeline), PASS + name
    try:
        made = twinform.convert(model.before.text, to=same, passes=pipeline)
    except twinform.CompileError as error:
        refused = Verdict(Outcome.REFUSED, (), rules_of(error.diagnostics))
        return b"", Tried(model.name, model.way, kind, refused, replay)
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        verdict = Verdict(Outcome.SILENT, (f"crash of the pass: {type(error).__name__}: {error}",))
        return b"", Tried(model.name, model.way, kind, verdict, replay)
    text = made.text.encode()
    verdict = judge(model.before, text, plainly=_PLAINLY.get(name, Plainly.SKELETON))
    return text, Tried(model.name, model.way, kind, verdict, replay)


def _kept(model: _Model, text: bytes, tried: Tried, random: Random) -> Tried:
    """With the files of a fault, or those that Drake is to see; and no longer the text of the result."""
    folder, pair = "", None
    if tried.verdict.is_fault:
        folder = _written(model, text, tried, "faults").name
    elif tried.verdict.result and random.randrange(_ONE_IN) == 0:
        place = _written(model, text, tried, "drake")
        edited, result = (".sdf", ".urdf") if model.job.is_urdf else (".urdf", ".sdf")
        pair = (place / f"edited{edited}", place / f"result{result}")
    few = {"differences": tried.verdict.differences[:8], "rules": tried.verdict.rules[:8]}
    verdict = replace(tried.verdict, **few, result=None)
    return Tried(tried.name, tried.way, tried.kind, verdict, tried.replay, folder, pair)


def _written(model: _Model, text: bytes, tried: Tried, where: str) -> Path:
    place = OUT / where / hashlib.sha256(tried.replay.encode()).hexdigest()[:12]
    edited, result = (".sdf", ".urdf") if model.job.is_urdf else (".urdf", ".sdf")
    kept(place / f"before{edited}", model.before.text.decode())
    kept(place / f"home{result}", model.before.result)
    kept(place / f"edited{edited}", text.decode())
    kept(place / f"result{result}", tried.verdict.result or "")
    kept(place / "report.txt", "\n".join((tried.replay, *tried.verdict.differences, *tried.verdict.rules, "")))
    return place


def job_named(name: str) -> Job:
    """The job of a file of the corpus or of `out/edits`, by its name in a report.

    Raises:
        LookupError: there is none.
    """
    for file in models():
        if file.name == name:
            return corpus_job(file, 0, 0)
    path = OUT / name if (OUT / name).is_file() else Path(name)
    if not path.is_file():
        raise LookupError(f"no file {name} in {CORPUS} or {OUT}")
    return Job(name, path, (), path.suffix == ".urdf", 0, 0)
