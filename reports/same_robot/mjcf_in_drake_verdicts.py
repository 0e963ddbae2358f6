"""What Drake makes of our MJCF of one file, beside the file; runs in a worker process, since Drake may end it."""

import importlib
import logging
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lxml import etree

import twinform
from reports.same_robot.drake_verdicts import cause
from reports.same_robot.reader_verdicts import Outcome, Verdict
from testbed import output_files
from testbed.corpus.examine import first_error
from testbed.corpus.files import CorpusFile, Kind
from testbed.engines.readers.meshless import without_meshes as boxed
from testbed.mjcf.compiled import without_meshes
from testbed.output_files import kept
from twinform.testing import oracles
from twinform.testing.oracles.robot_comparison import read_robot, verdict_on

_DRAKE = "drake"
_OUT = output_files.OUT / "mjcf_in_drake"
_TOKEN = {"pos": "0 0 0", "mass": "1e-12", "diaginertia": "1e-14 1e-14 1e-14"}
"""The `<inertial>` of a body that has none, which Drake would refuse."""
_UNSAID = "velocity"
"""The limit of joints that MJCF has no word for."""
_GEOM = re.compile(r"(?<=geom )\S+ specified \S+ and \S+;")
"""What differs from geom to geom in what Drake says of them."""


@dataclass(frozen=True, slots=True)
class DrakeOutcome(Outcome):
    """What became of a file, the largest difference, and what Drake said while it read the MJCF."""

    deviation: float = 0.0
    of: str = ""
    said: tuple[str, ...] = ()


def judge(file: CorpusFile) -> list[DrakeOutcome]:
    """What becomes of a URDF, or of an SDF without a world. No exception comes out of it."""
    data = file.path.read_bytes()
    if b"<world" in data:
        return []
    kind = ("URDF" if file.kind is Kind.URDF else "SDF model",)
    try:
        source = read_robot(file.path, _DRAKE)
    except oracles.EngineUnreadableError as error:
        return [DrakeOutcome(file.name, kind, Verdict.SOURCE, cause(error.cause))]
    try:
        written = twinform.convert(boxed(data) if file.kind is Kind.URDF else file.path, to="mjcf", paths=file.paths)
    except twinform.CompileError as error:
        return [DrakeOutcome(file.name, kind, Verdict.NOT_WRITTEN, first_error(error.diagnostics))]
    made = kept(_OUT / f"{file.name}.xml", _weighed(without_meshes(written.text)))
    limits = {name: {key: end for key, end in ends.items() if key != _UNSAID} for name, ends in source.limits.items()}
    try:
        found = verdict_on(replace(source, limits=limits), (file.path, made), (_DRAKE, _DRAKE))
    except oracles.EngineUnreadableError as error:
        return [DrakeOutcome(file.name, kind, Verdict.REFUSED, cause(error.cause))]
    same = Verdict.SAME if found else Verdict.DIFFERENT
    return [DrakeOutcome(file.name, kind, same, found.cause, found.deviation, found.of, _warnings(made))]


def _weighed(text: str) -> str:
    """MJCF in which every body has mass."""
    root = etree.fromstring(text.encode())
    for body in root.iter("body"):
        if body.find("inertial") is None:
            body.insert(0, etree.Element("inertial", _TOKEN))
    return etree.tostring(root, encoding="unicode")


class _Listener(logging.Handler):
    """Keeps what is said, without names and numbers."""

    def __init__(self) -> None:
        super().__init__()
        self.said: dict[str, None] = {}

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a message."""
        message = record.getMessage().partition("warning: ")[2].partition("\n")[0]
        self.said[_GEOM.sub("with `contype` or `conaffinity`:", message)] = None


def _warnings(path: Path) -> tuple[str, ...]:
    """What Drake says while it reads a file with all of its shapes."""
    plants: Any = importlib.import_module("pydrake.multibody.plant")
    parsing: Any = importlib.import_module("pydrake.multibody.parsing")
    geometry: Any = importlib.import_module("pydrake.geometry")
    plant, shapes = plants.MultibodyPlant(0.001), geometry.SceneGraph()
    plant.RegisterAsSourceForSceneGraph(shapes)
    logger, listener = logging.getLogger(_DRAKE), _Listener()
    logger.setLevel(logging.WARNING)
    logger.propagate = False
    logger.addHandler(listener)
    try:
        parsing.Parser(plant).AddModels(str(path))
    except RuntimeError as error:
        return (str(error).partition("\n")[0],)
    finally:
        logger.removeHandler(listener)
    return tuple(listener.said)
