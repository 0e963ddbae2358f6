"""One SDF model in other versions, before Drake; runs in a worker process, since Drake may take it down."""

from dataclasses import dataclass
from pathlib import Path

import twinform
from reports.same_robot.drake_verdicts import DRAKE
from testbed.corpus.files import CorpusFile
from testbed.corpus.versions import NEWEST
from testbed.output_files import OUT, kept
from twinform.testing import oracles
from twinform.testing.oracles.robot import EngineRobot
from twinform.testing.oracles.robot_comparison import read_robot, verdict_on

VERSIONS = ("1.11", "1.6")
"""What Drake is given: the newest version that it reads, and one without named frames."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """A model in two versions: the verdict, and its cause where they are not the same."""

    name: str
    subject: str
    verdict: str
    cause: str = ""


def judge(file: CorpusFile) -> list[Comparison]:
    """The model as it is, and in other versions; no exception comes out of it."""
    try:
        source = read_robot(file.path, DRAKE)
    except oracles.EngineUnreadableError:
        return [Comparison(file.name, "the file", "not read by Drake")]
    return [_compare(file, source, version) for version in VERSIONS]


def _compare(file: CorpusFile, source: EngineRobot, version: str) -> Comparison:
    subject = f"the file and the same in {version}"
    try:
        path = _written(file, version)
    except twinform.CompileError as error:
        return Comparison(file.name, subject, "refused", error.diagnostics[0].message)
    try:
        found = verdict_on(source, (file.path, path), (DRAKE, DRAKE))
    except oracles.EngineUnreadableError as error:
        return Comparison(file.name, subject, "result not read by Drake", _cause(error.cause))
    return Comparison(file.name, subject, f"same ({found.alike})" if found.alike else "different", found.cause)


def _cause(message: str) -> str:
    """The message of Drake, without the name of the file."""
    return message.strip().partition("\n")[0].rpartition("error: ")[2][:160]


def _written(file: CorpusFile, version: str) -> Path:
    """The file in the newest version and from there in this one, which goes over every step that there is."""
    newest = twinform.convert(file.path, to="sdf", sdf_version=NEWEST, paths=file.paths).text
    text = twinform.convert(newest.encode(), to="sdf", sdf_version=version, name=file.name).text
    return kept(OUT / "versions" / f"{file.name}.{version}.sdf", text)
