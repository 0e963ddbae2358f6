"""One model, converted, edited many times and converted on: what a worker process of the report does."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from random import Random

import twinform
from testbed import output_files
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CORPUS, CorpusFile, Kind, models
from testbed.corpus.there_and_back import robots
from testbed.edits import Edit, apply_all, draw_edits
from testbed.edits import passes as edit_passes
from testbed.edits.edited_file import EditedFile, Language
from testbed.edits.judging import Converted, Outcome, Verdict, judge, judge_edits, unedited
from testbed.edits.mistakes import KIND as MISTAKE
from testbed.edits.plainly import Plainly
from testbed.edits.trips import TRIPS, Draw, trips
from testbed.mjcf.canonical_models import PACKAGES
from testbed.output_files import kept
from twinform.passes.includes.expand import has_includes

OUT = output_files.OUT / "edits"
MOST_BYTES = 400_000
"""Converted files that are larger are not edited: it would take longer than all others together."""
SEVERAL = "two or three of these"
PASS = "pass: "
TRIP = "trip "
NO_ROUND_TRIP = "no round trip without an edit"
_USUAL_BYTES = 60_000
_PASSES = 2
_PLAINLY = {"attach": Plainly.NONE}
"""The other model that is attached has carriers of its own."""
_VERSIONS = ("1.11",) * 7 + ("1.9", "1.8", "1.6")
_ONE_IN = 20
"""So many of the edits that won are shown to Drake."""


@dataclass(frozen=True, slots=True)
class Job:
    """A model: a file of the corpus or of a package, or of `out/edits`; `edits` of it in another language are tried."""

    name: str
    path: Path
    paths: tuple[Path, ...]
    language: Language
    edited: Language
    seed: int
    edits: int

    @property
    def is_urdf(self) -> bool:
        """Whether the file is URDF."""
        return self.language == "urdf"


@dataclass(frozen=True, slots=True)
class Tried:
    """One edit of one converted model, or one pass; `replay` repeats it, `folder` has the files of a fault."""

    direction: str
    kind: str
    verdict: Verdict
    replay: str
    folder: str = ""
    pair: tuple[Path, Path] | None = None


@dataclass(frozen=True, slots=True)
class Done:
    """All that was tried on a model; `left_out` is why nothing was, `differing` what differs without an edit."""

    name: str
    left_out: str = ""
    differing: tuple[str, ...] = ()
    tried: tuple[Tried, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot of a file, and the version of SDF that it is converted to."""

    job: Job
    robot: str | None
    version: str | None

    @property
    def name(self) -> str:
        """The file, and what of it."""
        return " ".join(filter(None, (self.job.name, self.robot, self.version)))

    @property
    def formats(self) -> tuple[Language, Language]:
        """The format that is edited, and that of the source and the result."""
        return self.job.edited, self.job.language

    def tried(self, kind: str, verdict: Verdict, what: str) -> Tried:
        """The verdict on an edit or pass."""
        replay = json.dumps([self.job.name, self.job.edited, self.robot, self.version, what], ensure_ascii=False)
        edited, source = (each.upper() for each in self.formats)
        return Tried(f"{source} -> {edited}, edited -> {source}", kind, verdict, replay)


@dataclass(frozen=True, slots=True)
class Model(Robot):
    """A robot on the other side."""

    before: Converted

    @property
    def formats(self) -> tuple[Language, Language]:
        """The same, which turn around with each trip."""
        own, other = self.job.edited, self.job.language
        return (own, other) if self.before.to == other else (other, own)


def corpus_jobs(seed: int, edits: dict[bool, int]) -> Iterator[Job]:
    """A job for each model file of the corpus; `edits` is how many for URDF, and for SDF."""
    return (corpus_job(file, seed, edits[file.kind is Kind.URDF]) for file in models())


def corpus_job(file: CorpusFile, seed: int, edits: int) -> Job:
    """The job of one file."""
    is_urdf = file.kind is Kind.URDF
    return Job(file.name, file.path, file.paths, *(("urdf", "sdf") if is_urdf else ("sdf", "urdf")), seed, edits)


def work(job: Job) -> list[Done]:
    """Convert the robots of a file, and try edits and passes on each."""
    random = Random(f"{job.seed} {job.name}" + (f" {job.edited}" if "mjcf" in {job.edited, job.language} else ""))
    try:
        checked = twinform.check(job.path, paths=job.paths)
    except Exception as error:  # noqa: BLE001 - that is the business of the report on the corpus
        return [Done(job.name, f"not read: {type(error).__name__}")]
    if checked.document is None or not checked.accepted:
        return []
    among = robots(checked.document)
    if job.edited == "mjcf" and len(among) > 1 and not has_includes(checked.document):
        among = [None, *among[1:]]  # MJCF holds a world as a whole
    return [_worked(job, robot, max(1, job.edits // len(among)), random) for robot in among]


def _worked(job: Job, robot: str | None, edits: int, random: Random) -> Done:
    version = random.choice(_VERSIONS) if (job.language, job.edited) == ("urdf", "sdf") else None
    subject = Robot(job, robot, version)
    model = converted(subject)
    if isinstance(model, str):
        lost = subject.tried(NO_ROUND_TRIP, Verdict(Outcome.SILENT, (model,)), "[]")
        return Done(subject.name, model, tried=(lost,) if model.startswith(NO_ROUND_TRIP) else ())
    count = edits if len(model.before.text) < _USUAL_BYTES else max(1, edits // 4)
    passes = () if job.edited == "mjcf" else _passes(model, random)  # which no pass is made for
    tried = [*_edits(model, count, random), *passes, *_trips(model, random)]
    differing = tuple(sorted(": ".join(filter(None, key)) for key in model.before.differing))
    return Done(model.name, "", differing, tuple(tried))


def converted(one: Robot) -> Model | str:
    """A robot on the other side, and what differs before any edit; or why there is none."""
    job = one.job
    try:
        conversion = twinform.convert(
            job.path, to=one.formats[0], sdf_version=one.version, model=one.robot, paths=job.paths
        )
        text = conversion.text.encode()
    except twinform.CompileError as error:
        return f"not converted: {', '.join(rules_of(error.diagnostics))}"
    if len(text) > MOST_BYTES:
        return f"too large: {len(text) // 1000} kB"
    try:
        return Model(job, one.robot, one.version, unedited(text, job.language))
    except Exception as error:  # noqa: BLE001 - whatever it is, what was converted must convert back
        rules = rules_of(error.diagnostics) if isinstance(error, twinform.CompileError) else (str(error),)
        return f"{NO_ROUND_TRIP}: {type(error).__name__}: {', '.join(rules)}"


def again(model: Model, what: str) -> tuple[bytes, Tried]:
    """The edit or pass of a replay."""
    if what.startswith(PASS):
        pipeline = what.removeprefix(PASS)
        return _passed(model, pipeline.partition("{")[0], pipeline)
    if what.startswith(TRIP):
        made = [tuple(map(_edit, each)) for each in json.loads(what.removeprefix(TRIP))]
        *_, (_, text, tried) = _traveled(model, [partial(_applied, edits) for edits in made])
        return text, tried
    edits = tuple(map(_edit, json.loads(what)))
    return _edited(model, edits, apply_all(edits, model.before.text))


def _edits(model: Model, count: int, random: Random) -> Iterator[Tried]:
    for _ in range(count):
        edits, text = draw_edits(model.before.text, random)
        _, tried = _edited(model, edits, text)
        yield _keep_files(model, text, tried, random)


def _edited(model: Model, edits: tuple[Edit, ...], text: bytes) -> tuple[bytes, Tried]:
    verdict = judge_edits(model.before, edits, text)
    is_mistake = any(each.kind == MISTAKE for each in edits)
    kind = edits[0].kind if len(edits) == 1 else MISTAKE if is_mistake else SEVERAL
    replay = "[" + ", ".join(map(str, edits)) + "]"
    return text, model.tried(kind, verdict, replay)


def _trips(model: Model, random: Random) -> Iterator[Tried]:
    """Trips in a row, with edits before each one."""
    for here, text, tried in _traveled(model, [partial(draw_edits, random=random)] * TRIPS):
        yield _keep_files(here, text, tried, random)


def _traveled(model: Model, draws: list[Draw]) -> Iterator[tuple[Model, bytes, Tried]]:
    steps: list[str] = []
    for number, trip in enumerate(trips(model.before, draws), start=1):
        steps.append(f"[{', '.join(map(str, trip.edits))}]")
        here = replace(model, before=trip.before)
        yield here, trip.edited, here.tried(f"{TRIP}{number}", trip.verdict, f"{TRIP}[{', '.join(steps)}]")


def _edit(found: object) -> Edit:
    return Edit.from_text(json.dumps(found))


def _applied(edits: tuple[Edit, ...], text: bytes) -> tuple[tuple[Edit, ...], bytes]:
    return edits, apply_all(edits, text)


def _passes(model: Model, random: Random) -> Iterator[Tried]:
    for name in random.sample(edit_passes.NAMES, _PASSES):
        if (pipeline := edit_passes.pipeline(name, model.before.text, random)) is not None:
            text, tried = _passed(model, name, pipeline)
            yield _keep_files(model, text, tried, random)


def _passed(model: Model, name: str, pipeline: str) -> tuple[bytes, Tried]:
    kind, what = PASS + name, PASS + pipeline
    try:
        conversion = twinform.convert(model.before.text, to=model.formats[0], passes=pipeline)
    except twinform.CompileError as error:
        return b"", model.tried(kind, Verdict(Outcome.REFUSED, (), rules_of(error.diagnostics)), what)
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        verdict = Verdict(Outcome.SILENT, (f"crash of the pass: {type(error).__name__}: {error}",))
        return b"", model.tried(kind, verdict, what)
    text = conversion.text.encode()
    verdict = judge(model.before, text, plainly=_PLAINLY.get(name, Plainly.SKELETON))
    return text, model.tried(kind, verdict, what)


def _keep_files(model: Model, text: bytes, tried: Tried, random: Random) -> Tried:
    """With the files of a fault, or those that Drake is to see; and no longer the text of the result."""
    folder, pair = "", None
    if tried.verdict.is_fault:
        folder = written(model, text, tried, OUT / "faults" / _number(tried)).name
    elif tried.verdict.result and random.randrange(_ONE_IN) == 0:
        shown = written(model, text, tried, OUT / "drake" / _number(tried))
        edited, result = model.formats
        pair = (shown / f"edited.{edited}", shown / f"result.{result}")
    few = {"differences": tried.verdict.differences[:8], "rules": tried.verdict.rules[:8]}
    return replace(tried, verdict=replace(tried.verdict, **few, result=None), folder=folder, pair=pair)


def _number(tried: Tried) -> str:
    return hashlib.sha256(tried.replay.encode()).hexdigest()[:12]


def written(model: Model, text: bytes, tried: Tried, folder: Path) -> Path:
    """The folder, with all files of an edit or pass in it."""
    edited, result = model.formats
    kept(folder / f"before.{edited}", model.before.text.decode())
    kept(folder / f"back.{result}", model.before.result)
    kept(folder / f"edited.{edited}", text.decode())
    kept(folder / f"result.{result}", tried.verdict.result or "")
    kept(folder / "report.txt", "\n".join((tried.replay, *tried.verdict.differences, *tried.verdict.rules, "")))
    return folder


def job_named(name: str, edited: Language) -> Job:
    """The job of a file of the corpus, of a package or of `out/edits`, by its name in a report.

    Raises:
        LookupError: there is none.
    """
    for file in models():
        if file.name == name:
            return replace(corpus_job(file, 0, 0), edited=edited)
    path = next((each / name for each in (OUT, PACKAGES, Path()) if (each / name).is_file()), None)
    if path is None:
        raise LookupError(f"no file {name} in {CORPUS}, {PACKAGES} or {OUT}")
    paths = (PACKAGES,) if path.is_relative_to(PACKAGES) else ()
    return Job(name, path, paths, EditedFile(path.read_bytes()).language, edited, 0, 0)
