"""One file through the compiler and before the judge; runs in a worker process, since Drake may take it down."""

import re
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import twinform
from testbed import output_files
from testbed.corpus.examine import first_error
from testbed.corpus.files import CorpusFile, Kind
from testbed.output_files import kept
from twinform.testing import oracles
from twinform.testing.oracles.robot import EngineRobot
from twinform.testing.oracles.robot_comparison import read_robot, verdict_on

OUT = output_files.OUT / "oracle"
DRAKE = "drake"
_ASIDE = re.compile(r"^.*?:\d+(:\d+)?: (error|warning): |\S*/\S*|\b\d[\d.e+-]*\b")


class Direction(StrEnum):
    """The conversions that are judged."""

    TO_SDF_9 = "URDF -> SDF 1.9"
    TO_SDF_11 = "URDF -> SDF 1.11"
    TO_URDF = "SDF -> URDF"


class Verdict(StrEnum):
    """What became of one conversion."""

    FRAMES = "same (frames)"
    INERTIAL = "same (inertial)"
    DIFFERENT = "different"
    RESULT = "result not readable"
    SOURCE = "source not readable"
    REFUSED = "not converted"
    CRASH = "crash"


_VERDICTS = {
    oracles.Alike.FRAMES: Verdict.FRAMES,
    oracles.Alike.INERTIAL: Verdict.INERTIAL,
    None: Verdict.DIFFERENT,
}


@dataclass(frozen=True, slots=True)
class Outcome:
    """A conversion and its verdict; `cause` is why it is not the same."""

    name: str
    direction: Direction
    verdict: Verdict
    cause: str = ""
    difference: float = 0.0
    output: Path | None = None
    joints: int = 0


def directions(file: CorpusFile) -> tuple[Direction, ...]:
    """The conversions of a file that are judged."""
    return (Direction.TO_SDF_9, Direction.TO_SDF_11) if file.kind is Kind.URDF else (Direction.TO_URDF,)


def judge(file: CorpusFile) -> tuple[Outcome, ...]:
    """Convert a file in every direction and judge each result; no exception comes out of it."""
    source = load(file.path)
    return tuple(_judged(file, direction, source) for direction in directions(file))


def post_mortem(file: CorpusFile) -> tuple[Outcome, ...]:
    """For a file on which Drake ended the process: who was to blame, if this call comes back the result was."""
    load(file.path)
    return tuple(
        Outcome(file.name, direction, Verdict.RESULT, "Drake ends the process") for direction in directions(file)
    )


def _judged(file: CorpusFile, direction: Direction, source: EngineRobot | str) -> Outcome:
    try:
        output = _convert(file, direction)
    except twinform.CompileError as error:
        return Outcome(file.name, direction, Verdict.REFUSED, first_error(error.diagnostics))
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        return Outcome(file.name, direction, Verdict.CRASH, f"{type(error).__name__}: {error}")
    if isinstance(source, str):
        return Outcome(file.name, direction, Verdict.SOURCE, source, output=output)
    try:
        found = verdict_on(source, (file.path, output), (DRAKE, DRAKE))
    except oracles.EngineUnreadableError as error:
        return Outcome(file.name, direction, Verdict.RESULT, cause(error.cause), output=output)
    return Outcome(
        file.name, direction, _VERDICTS[found.alike], found.cause, found.deviation, output, len(source.joints)
    )


def _convert(file: CorpusFile, direction: Direction) -> Path:
    if direction is Direction.TO_URDF:
        text, suffix = twinform.convert(file.path, to="urdf", paths=file.paths).text, ".urdf"
    else:
        version = direction.rpartition(" ")[2]
        text, suffix = (
            twinform.convert(file.path, to="sdf", sdf_version=version, paths=file.paths).text,
            f".{version}.sdf",
        )
    return kept(OUT / f"{file.name}{suffix}", text)


def load(path: Path) -> EngineRobot | str:
    """What Drake sees, or why it sees nothing."""
    try:
        return read_robot(path, DRAKE)
    except oracles.EngineUnreadableError as error:
        return cause(error.cause)


def cause(message: str) -> str:
    """A message without file names and numbers, so that equal causes read the same."""
    line = next((line for line in message.splitlines() if line.strip()), message)
    return _ASIDE.sub(lambda match: "" if match.group(2) else "..", line).strip()[:160]
