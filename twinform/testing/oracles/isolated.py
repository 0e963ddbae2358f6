"""Comparison and simulation of two files with a physics engine, in a process of its own that may crash."""

from os import PathLike
from pathlib import Path

from twinform.testing.oracles.child import ChildDiedError, call
from twinform.testing.oracles.engines import required
from twinform.testing.oracles.verdict import EngineUnreadableError, Verdict


def compare(
    a: str | PathLike[str],
    b: str | PathLike[str],
    *,
    engine: str = "drake",
    other: str | None = None,
    lumped: bool = False,
) -> Verdict:
    """Whether two files are the same robot to a physics engine, and how far apart they are.

    Names, limits, masses, poses of links, centers of mass, inertias, mass matrix and gravity are compared at some sets
    of joint positions. The engine works in a process of its own.

    Args:
        a: URDF or SDF, as the engine reads it.
        b: URDF or SDF, as the engine reads it.
        engine: a name of `ENGINES`.
        other: the engine for `b`, where it is another one.
        lumped: weigh links together that are fixed to each other, as some engines do anyway.

    Raises:
        EngineMissingError: an engine is not installed.
        UnreadableError: an engine cannot read its file.
        ValueError: there is no such engine.
    """
    from twinform.testing.oracles import in_process  # noqa: PLC0415 - numpy, which is in the extra `oracles`

    engines = (engine, other or engine)
    for name in engines:
        required(name)
    first, second = Path(a).resolve(), Path(b).resolve()
    try:
        return call(in_process.compared, first, second, engines, lumped)
    except ChildDiedError:
        raise _culprit(first, second, engines) from None


def simulate(a: str | PathLike[str], b: str | PathLike[str], *, seconds: float = 1.0) -> Verdict:
    """Whether two files move alike when Drake lets them go from the same state, without control or contact.

    Args:
        a: URDF or SDF.
        b: URDF or SDF.
        seconds: for how long.

    Raises:
        EngineMissingError: Drake is not installed.
        UnreadableError: Drake cannot read or simulate a file.
    """
    from twinform.testing.oracles import dynamics  # noqa: PLC0415 - as above

    required("drake")
    first, second = Path(a).resolve(), Path(b).resolve()
    try:
        return call(dynamics.moved_alike, first, second, seconds)
    except ChildDiedError:
        raise _culprit(first, second, ("drake", "drake")) from None


def _culprit(first: Path, second: Path, engines: tuple[str, str]) -> EngineUnreadableError:
    """The file on which an engine ends its process."""
    from twinform.testing.oracles import in_process  # noqa: PLC0415 - as above

    try:
        call(in_process.read_robot, first, engines[0])
    except ChildDiedError as died:
        return EngineUnreadableError(engines[0], first, str(died))
    return EngineUnreadableError(engines[1], second, "it ends the process")
