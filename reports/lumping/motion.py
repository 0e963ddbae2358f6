"""Robots with fixed joints before and after lumping, let go in Drake."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import twinform
from reports.harness.files import OUT, kept
from reports.harness.sample import Sample, in_turn
from tests.corpus.files import CorpusFile, Kind
from twinform.ir import Document
from twinform.testing import oracles
from twinform.testing.oracles.dynamics import moved_alike

WANTED = 20
_SECONDS = 1.0
_PATIENCE = 40
_JOINTS = 1


@dataclass(frozen=True, slots=True)
class Mode:
    """A method of lumping, the format of the robots that it is tried on, and that of the result."""

    name: str
    source: Literal["urdf", "sdf"]
    target: Literal["urdf", "sdf"]
    passes: str


MODES = (
    Mode("URDF", "urdf", "urdf", "lump-fixed-joints"),
    Mode("URDF to SDF, as libsdformat", "urdf", "sdf", "lump-fixed-joints{compat=libsdformat}"),
    Mode("SDF", "sdf", "sdf", "lump-fixed-joints"),
)
_UNFIT = frozenset({"impossible-inertia", "indefinite-inertia"})
"""Drake puts inertias of its own in the place of these, and others when links are lumped."""


@dataclass(frozen=True, slots=True)
class Moved:
    """A robot, and how far it came from where it would have been; no verdict where Drake cannot simulate it."""

    mode: str
    name: str
    links: int = 0
    lumped: int = 0
    verdict: oracles.Verdict | None = None
    cause: str = ""

    @property
    def differs(self) -> bool:
        """Whether it moves otherwise."""
        return self.verdict is not None and not self.verdict

    @property
    def gap(self) -> float:
        """The largest difference of a position or velocity."""
        return self.verdict.deviation if self.verdict is not None else math.inf

    @property
    def summary(self) -> str:
        """In short."""
        return "the same" if self.verdict else self.cause


def moved(mode: Mode, sample: Sample) -> list[Moved]:
    """As many robots as are wanted that Drake can simulate, from as many repositories as there are."""
    candidates = in_turn(sample.models(Kind(mode.source)))
    found: list[Moved] = []
    while candidates and len(found) < WANTED:
        now, candidates = candidates[:WANTED], candidates[WANTED:]
        answers = dict(sample.run(_move, [(mode, file) for file in now], seconds=_PATIENCE))
        judged = [answers[mode, file] for file in now]
        found += [one for one in judged if isinstance(one, Moved) and one.verdict is not None]
    return found[:WANTED]


def _move(job: tuple[Mode, CorpusFile]) -> Moved:
    mode, file = job
    nothing = Moved(mode.name, file.name)
    try:
        plain = twinform.load(file.path, paths=file.paths)
        if not _is_interesting(plain) or _UNFIT & {
            each.rule.name for each in twinform.check(file.path, paths=file.paths).diagnostics
        }:
            return nothing
        conversion = twinform.convert(file.path, to=mode.target, passes=mode.passes, paths=file.paths)
        source = _source(mode, file)
    except twinform.CompileError:
        return nothing
    links = _bodies(plain)
    lumped = links - _bodies(conversion.document)
    if not lumped:
        return nothing
    output = _written(mode.name, mode, file, conversion.text)
    try:
        verdict = moved_alike(source, output, _SECONDS)
    except oracles.UnreadableError as error:
        if error.path != output:
            return nothing
        cause = error.cause.replace(str(output), output.name)
        verdict = oracles.Verdict("drake", None, math.inf, "", f"only the source can be simulated: {cause}")
    return Moved(mode.name, file.name, links, lumped, verdict, verdict.cause)


def _is_interesting(document: Document) -> bool:
    """Whether it is one robot, with fixed joints and some that move."""
    if len(document.models) != 1:
        return False
    types = [joint.type for joint in document.models[0].joints]
    return "fixed" in types and len([each for each in types if each != "fixed"]) >= _JOINTS


def _bodies(document: Document) -> int:
    """The links that have mass; in SDF all have."""
    links = document.models[0].links
    if document.format == "sdf":
        return len(links)
    return sum(1 for link in links if link.inertial is not None and link.inertial.mass)


def _source(mode: Mode, file: CorpusFile) -> Path:
    """The robot as it is, in the format of the result: Drake reads rotors of motors in URDF, and not in SDF."""
    if mode.source == mode.target:
        return file.path
    return _written("as it is", mode, file, twinform.convert(file.path, to=mode.target, paths=file.paths).text)


def _written(folder: str, mode: Mode, file: CorpusFile, text: str) -> Path:
    """A robot in a file; Drake is not asked for meshes."""
    root = OUT / "lumping" / "motion" / folder.replace(" ", "_").replace(",", "")
    return kept(root / f"{file.name}.{mode.target}", text)
