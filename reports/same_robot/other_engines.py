"""One conversion before an engine that reads one of the formats alone, or reads it differently."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import twinform
from reports.harness.sample import Sample
from reports.same_robot.drake_verdicts import DRAKE, OUT, Direction, Outcome, cause
from testbed.corpus.files import CORPUS
from twinform.compiler.workers import Failure
from twinform.testing import oracles
from twinform.testing.oracles.robot_comparison import compared, read_robot

LIBSDFORMAT = "libsdformat"
URDF_ONLY = ("pinocchio", "mujoco", "pybullet")


class Answer(StrEnum):
    """What an engine makes of a source and its result."""

    SAME = "same"
    DIFFERENT = "different"
    RESULT = "result not readable"
    SOURCE = "source not readable"


@dataclass(frozen=True, slots=True)
class Question:
    """Two files of one robot, and the engine for each of them."""

    name: str
    what: str
    source: Path
    result: Path
    engines: tuple[str, str]

    @property
    def engine(self) -> str:
        """The engine that is not Drake."""
        return self.engines[1]


@dataclass(frozen=True, slots=True)
class Agreement:
    """The answer to a question, and its cause where it is not that the two are the same."""

    question: Question
    answer: Answer
    cause: str = ""
    deviation: float = 0.0


def agreements(sample: Sample, outcomes: Iterable[Outcome]) -> list[Agreement]:
    """What the engines other than Drake, as far as they are here, find in the results."""
    questions = [one for one in _questions(outcomes) if oracles.available(one.engine)]
    answered = list(sample.run(_answer, questions))
    died = [question for question, answer in answered if isinstance(answer, Failure)]
    found = [answer for _, answer in answered if isinstance(answer, Agreement)]
    return found + [_died(question, answer) for question, answer in sample.run(_source, died)]


def _questions(outcomes: Iterable[Outcome]) -> Iterator[Question]:
    for one in outcomes:
        if one.output is None:
            continue
        source = CORPUS / one.name
        if one.direction is Direction.TO_SDF_9:
            yield Question(one.name, "URDF and SDF 1.9", source, one.output, (LIBSDFORMAT, LIBSDFORMAT))
        elif one.direction is Direction.TO_SDF_11:
            back = OUT / f"{one.name}.back.urdf"
            what = "URDF, and the same after SDF 1.11"
            yield from (Question(one.name, what, source, back, (name, name)) for name in URDF_ONLY)
        else:
            what = "SDF in Drake, and URDF"
            yield from (Question(one.name, what, source, one.output, (DRAKE, name)) for name in URDF_ONLY)
            yield Question(one.name, "SDF and URDF", source, one.output, (LIBSDFORMAT, LIBSDFORMAT))


def _answer(question: Question) -> Agreement:
    try:
        _write(question)
        found = compared(question.source, question.result, question.engines, lumped=False)
    except oracles.EngineUnreadableError as error:
        answer = Answer.SOURCE if error.path == question.source else Answer.RESULT
        return Agreement(question, answer, cause(error.cause))
    except twinform.CompileError as error:
        return Agreement(question, Answer.RESULT, cause(str(error)))
    return Agreement(question, Answer.SAME if found else Answer.DIFFERENT, found.cause, found.deviation)


def _write(question: Question) -> None:
    """The conversion back, where a question is about it."""
    if question.result.name.endswith(".back.urdf"):
        there = question.result.with_name(question.result.name.replace(".back.urdf", ".1.11.sdf"))
        # the same file is made for every engine, perhaps at the same time
        twinform.write_atomically(question.result, twinform.convert(there, to="urdf").text)


def _source(question: Question) -> None:
    """Read the source alone: if this comes back, an engine ended its process on the result."""
    try:
        read_robot(question.source, question.engines[0])
    except oracles.EngineUnreadableError:
        return


def _died(question: Question, answer: Failure | None) -> Agreement:
    found = Answer.SOURCE if isinstance(answer, Failure) else Answer.RESULT
    return Agreement(question, found, f"{question.engine} ends the process")
