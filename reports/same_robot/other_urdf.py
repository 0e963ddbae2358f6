"""One robot in every version of URDF, before urdfdom and Drake; runs in a worker process, since Drake may end it."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path

import twinform
from reports.same_robot.drake_verdicts import DRAKE, cause, load
from reports.same_robot.reader_verdicts import Outcome, Verdict
from testbed.corpus.examine import first_error
from testbed.corpus.files import CorpusFile
from testbed.oracles import urdfdom
from testbed.output_files import OUT, kept
from twinform.request_options import URDF_VERSIONS, UrdfVersion
from twinform.testing import oracles
from twinform.testing.oracles.robot import EngineRobot
from twinform.testing.oracles.robot_comparison import verdict_on

_FOLDER = OUT / "urdf_versions"
_READERS: Mapping[str, tuple[Callable[[Path], tuple[str, ...]], tuple[UrdfVersion, ...]]] = {
    "urdfdom 6": (urdfdom.complaints_of_6, URDF_VERSIONS),
    "urdfdom 3": (urdfdom.complaints, ("1.0",)),
}
"""The parsers of ROS, with the versions that each of them reads."""


def judge(file: CorpusFile) -> list[Outcome]:
    """The robot in every version before every reader; nothing where it has errors. No exception comes out of it."""
    if not twinform.check(file.path, paths=file.paths).accepted:
        return []
    drake = partial(_of_drake, file.path, load(file.path))
    return [outcome for version in URDF_VERSIONS for outcome in _judged(file, version, drake)]


def _judged(file: CorpusFile, version: UrdfVersion, drake: Callable[[Path], tuple[Verdict, str]]) -> Iterator[Outcome]:
    readers = [name for name, (_, versions) in _READERS.items() if version in versions]
    try:
        text = twinform.convert(file.path, to="urdf", urdf_version=version, paths=file.paths).text
    except twinform.CompileError as error:
        why = first_error(error.diagnostics)
        yield from (Outcome(file.name, (version, name), Verdict.NOT_WRITTEN, why) for name in (*readers, DRAKE))
        return
    made = kept(_FOLDER / f"{file.name}.{version}.urdf", text)
    yield from (Outcome(file.name, (version, name), *_of_urdfdom(name, file.path, made)) for name in readers)
    yield Outcome(file.name, (version, DRAKE), *drake(made))


def _of_urdfdom(name: str, source: Path, made: Path) -> tuple[Verdict, str]:
    complaints, _ = _READERS[name]
    found = complaints(made)
    if not found:
        return Verdict.TAKEN, ""
    return Verdict.SOURCE if set(complaints(source)) >= set(found) else Verdict.REFUSED, cause(found[0])


def _of_drake(source: Path, robot: EngineRobot | str, made: Path) -> tuple[Verdict, str]:
    if isinstance(robot, str):
        return Verdict.SOURCE, robot
    try:
        found = verdict_on(robot, (source, made), (DRAKE, DRAKE))
    except oracles.EngineUnreadableError as error:
        return Verdict.REFUSED, cause(error.cause)
    return (Verdict.SAME, "") if found.alike else (Verdict.DIFFERENT, found.cause)
