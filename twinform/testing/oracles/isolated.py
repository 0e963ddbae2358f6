"""Comparison and simulation of two files with a physics engine, in a process of its own that may crash."""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from twinform.child_python import python_command
from twinform.testing.oracles.engines import EngineUnreadableError, Verdict, required


def compare(
    a: str | PathLike[str],
    b: str | PathLike[str],
    *,
    engine: str = "drake",
    other: str | None = None,
    lumped: bool = False,
) -> Verdict:
    """Compare two files with a physics engine, which runs in a process of its own: are they the same robot?

    Compares names, limits, masses, link poses, centers of mass, inertias, the mass matrix and gravity, at several sets
    of joint positions.

    Args:
        a: URDF or SDF, whichever the engine reads.
        b: URDF or SDF, whichever the engine reads.
        engine: a name in `ENGINES`.
        other: the engine for `b`; by default the same.
        lumped: weigh links together that are fixed to each other, as some engines do anyway.

    Raises:
        EngineMissingError: an engine is not installed.
        EngineUnreadableError: an engine cannot read its file.
        ValueError: there is no such engine.
    """
    from twinform.testing.oracles import robot_comparison  # noqa: PLC0415 - numpy, which is in the extra `oracles`

    engines = (engine, other or engine)
    for name in engines:
        required(name)
    first, second = Path(a).resolve(), Path(b).resolve()
    try:
        return call(robot_comparison.compared, first, second, engines, lumped)
    except ChildDiedError:
        raise _culprit(first, second, engines) from None


def simulate(a: str | PathLike[str], b: str | PathLike[str], *, seconds: float = 1.0) -> Verdict:
    """Let two files go from the same state in Drake, without control or contact: do they move alike?

    Args:
        a: URDF or SDF.
        b: URDF or SDF.
        seconds: how long to simulate.

    Raises:
        EngineMissingError: Drake is not installed.
        EngineUnreadableError: Drake cannot read or simulate a file.
    """
    from twinform.testing.oracles import drake  # noqa: PLC0415 - as above

    required("drake")
    first, second = Path(a).resolve(), Path(b).resolve()
    try:
        return call(drake.moved_alike, first, second, seconds)
    except ChildDiedError:
        raise _culprit(first, second, ("drake", "drake")) from None


def _culprit(first: Path, second: Path, engines: tuple[str, str]) -> EngineUnreadableError:
    """Find out which of two files makes an engine end its process."""
    from twinform.testing.oracles import robot_comparison  # noqa: PLC0415 - as above

    try:
        call(robot_comparison.read_robot, first, engines[0])
    except ChildDiedError as died:
        return EngineUnreadableError(engines[0], first, str(died))
    return EngineUnreadableError(engines[1], second, "it ends the process")


Result = TypeVar("Result")


class ChildDiedError(Exception):
    """The process ended before the function returned."""


def call(function: Callable[..., Result], *arguments: Any, seconds: float | None = None) -> Result:
    """Call a function in another process, and return or raise what it does; arguments and result must be picklable.

    Raises:
        ChildDiedError: the process ended without an answer, or took longer than `seconds`.
    """
    # Engines abort on models that they did not expect, and write to the terminal as they like.
    command = python_command("-m", "twinform.testing.oracles.isolated")
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(part for part in sys.path if part)}
    question = pickle.dumps((function, arguments))
    try:
        done = subprocess.run(
            command, input=question, capture_output=True, check=False, timeout=seconds, env=environment
        )
    except subprocess.TimeoutExpired as expired:
        raise ChildDiedError(f"no answer within {seconds:g} s") from expired
    if done.returncode:
        raise ChildDiedError(f"the process ended with {done.returncode}")
    returned, answer = pickle.loads(done.stdout)  # noqa: S301 - it comes from our own process
    if returned:
        return answer
    raise answer


def _serve() -> None:
    # what engines print must not get into the answer
    answer = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    function, arguments = pickle.load(sys.stdin.buffer)  # noqa: S301 - it comes from the process that started this one
    try:
        result = (True, function(*arguments))
    except Exception as error:  # noqa: BLE001 - whatever it is, the other process raises it
        result = (False, error)
    pickle.dump(result, answer)
    answer.flush()
    # skips the engines' own cleanup, some of which crashes
    os._exit(0)


if __name__ == "__main__":
    _serve()
