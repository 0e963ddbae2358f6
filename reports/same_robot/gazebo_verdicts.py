"""Corpus files in Gazebo's physics, beside what the compiler makes of them."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import TypeGuard

from reports.harness.known import Known
from testbed import output_files
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines import gazebo
from testbed.engines.gazebo.comparison import differences
from testbed.engines.gazebo.differing import Difference, Tolerances
from testbed.output_files import SDF_VERSION, converted, kept
from twinform.compiler.workers import Failure, run

OUT = output_files.OUT / "gazebo"
KNOWN = Known(Path(__file__).with_name("gazebo_runs.toml"))
SETTINGS = gazebo.Settings(steps=200, dt=0.001, start=0.5)
ENGINES = {
    gazebo.PhysicsEngine.DART: Tolerances(),
    gazebo.PhysicsEngine.BULLET: Tolerances(at_rest=1e-6, moved=None),
}
"""Bullet has single precision here and moves fixed joints, so that only what it loads is compared."""


LUMPING = (
    "libsdformat 12 lumps fixed joints into another inertia or link; with `preserveFixedJoint` it is the same robot, "
    "or refused alike"
)
_JOINT_TAG = re.compile(r"<joint\b[^>]*>")
_FIXED = re.compile(r"""\btype\s*=\s*["']fixed["']""")
_NAME = re.compile(r"""\bname\s*=\s*["']([^"']*)["']""")
_END = re.compile(r"</robot\s*>")


class Direction(StrEnum):
    """The conversions that are judged."""

    TO_SDF = f"URDF -> SDF {SDF_VERSION}"
    TO_URDF = "SDF -> URDF"


class Verdict(StrEnum):
    """What became of one conversion in one engine."""

    SAME = "same"
    KNOWN = "different for a known cause"
    DIFFERENT = "different"
    ONLY_RESULT = "only the result loads"
    NEITHER = "neither loads"
    CRASH = "the result crashes the engine"
    REFUSED = "not converted"


@dataclass(frozen=True, slots=True)
class Outcome:
    """A conversion in an engine; differences come with the reason where it is known."""

    name: str
    direction: Direction
    engine: gazebo.PhysicsEngine
    verdict: Verdict
    differences: tuple[tuple[Difference, str], ...] = ()
    ending: str = ""
    """How the result ended where it does not load."""


@dataclass(frozen=True, slots=True)
class _Pair:
    """A source with its result, None where it is refused."""

    file: CorpusFile
    result: Path | None

    @property
    def direction(self) -> Direction:
        return Direction.TO_SDF if self.file.kind is Kind.URDF else Direction.TO_URDF


def outcomes(files: Iterable[CorpusFile]) -> Iterator[Outcome]:
    """Convert and judge every file in every engine that is installed."""
    results = run(_converted, list(files), processes=1)
    pairs = [_Pair(file, None if isinstance(result, Failure) else result) for file, result in results]
    for engine in filter(gazebo.available, ENGINES):
        yield from _in_engine(pairs, engine)


def _converted(file: CorpusFile) -> Path | None:
    return converted(file, OUT / file.name)


def _in_engine(pairs: list[_Pair], engine: gazebo.PhysicsEngine) -> Iterator[Outcome]:
    files = [path for pair in pairs for path in (pair.file.path, pair.result) if path]
    found = gazebo.simulate(files, engine, SETTINGS)
    first = [_outcome(pair, engine, found) for pair in pairs]
    doubted = [pair for pair, one in zip(pairs, first, strict=True) if one.verdict is Verdict.DIFFERENT]
    unlumped = {path: _unlumped(path) for pair in doubted for path in (pair.file.path, pair.result) if _is_urdf(path)}
    again = gazebo.simulate(unlumped.values(), engine, SETTINGS)
    found |= {path.resolve(): again[other.resolve()] for path, other in unlumped.items()}
    for pair, outcome in zip(pairs, first, strict=True):
        second = _outcome(pair, engine, found) if pair in doubted else outcome
        lumped = second is not outcome and second.verdict in {Verdict.SAME, Verdict.KNOWN, Verdict.NEITHER}
        yield replace(outcome, verdict=Verdict.KNOWN, differences=_for(outcome, LUMPING)) if lumped else outcome


def _is_urdf(path: Path | None) -> TypeGuard[Path]:
    return path is not None and path.suffix == ".urdf"


def _for(outcome: Outcome, reason: str) -> tuple[tuple[Difference, str], ...]:
    return tuple((difference, why or reason) for difference, why in outcome.differences)


def _unlumped(path: Path) -> Path:
    """A URDF with the extension that keeps each of its fixed joints in SDF."""
    text = path.read_text(encoding="utf-8", errors="replace")
    fixed = [tag for tag in _JOINT_TAG.findall(text) if _FIXED.search(tag)]
    names = [name[1] for tag in fixed if (name := _NAME.search(tag))]
    added = "".join(
        f'<gazebo reference="{name}"><preserveFixedJoint>true</preserveFixedJoint></gazebo>' for name in names
    )
    output = OUT / "unlumped" / path.resolve().relative_to(path.resolve().anchor)
    return kept(output, _END.sub(lambda end: added + end[0], text))


def _outcome(pair: _Pair, engine: gazebo.PhysicsEngine, found: dict[Path, gazebo.Simulation]) -> Outcome:
    reference = found[pair.file.path.resolve()]
    about = (pair.file.name, pair.direction, engine)
    if pair.result is None:
        return Outcome(*about, Verdict.REFUSED, ending=f"{'' if reference.done else 'not '}loaded from its source")
    result = found[pair.result.resolve()]
    ending = "" if result.done else f"{result.outcome}: {'; '.join(result.errors or result.console.errors)}"
    if not reference.done:
        return _alone(Outcome(*about, Verdict.NEITHER, ending=ending), result)
    frames = pair.direction is Direction.TO_SDF
    differing = tuple(differences(reference, result, ENGINES[engine], frames=frames))
    errors = "; ".join(reference.console.errors)
    reasons = tuple((each, reason(pair.file.name, engine, pair.direction, each, errors)) for each in differing)
    if not differing:
        return Outcome(*about, Verdict.SAME)
    verdict = Verdict.KNOWN if all(why for _, why in reasons) else Verdict.DIFFERENT
    return Outcome(*about, verdict, reasons, ending)


def _alone(outcome: Outcome, result: gazebo.Simulation) -> Outcome:
    """The outcome where the source does not load."""
    if result.done:
        return replace(outcome, verdict=Verdict.ONLY_RESULT)
    if result.outcome is gazebo.Outcome.REFUSED:
        return outcome
    crash = Difference("crashes the engine", "", outcome.ending)
    why = reason(outcome.name, outcome.engine, outcome.direction, crash, "")
    return replace(outcome, verdict=Verdict.KNOWN if why else Verdict.CRASH, differences=((crash, why),))


def reason(name: str, engine: str, direction: str, difference: Difference, errors: str) -> str:
    """Why a difference is right; empty where nobody has examined it. A pattern that is not given fits everything.

    `errors` are the error lines that the reference gets.
    """
    return KNOWN.why("known", file=name, engine=engine, direction=direction, difference=str(difference), errors=errors)
