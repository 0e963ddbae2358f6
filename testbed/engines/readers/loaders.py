"""The loaders that profiles describe: which reader stands for which profile, and its verdict on a file."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from testbed.engines.readers.library import READERS, SCENES, Reader, Reading

_URDFDOM = r"^(?:Error|Warning): "
"""How console_bridge prints what urdfdom finds, for all that are built on it."""


class Verdict(StrEnum):
    """What a loader does with a file."""

    ACCEPTS = "accepts"
    WARNS = "warns"
    REFUSES = "refuses"


@dataclass(frozen=True, slots=True)
class Loader:
    """A reader as the consumer of a profile: `remark` finds the lines of its messages that are warnings."""

    profile: str
    reader: Reader
    remark: re.Pattern[str]

    def remarks(self, reading: Reading) -> tuple[str, ...]:
        """Its warnings about a file that it takes, and its errors that are not one to it."""
        return tuple(line for line in reading.output.splitlines() if self.remark.search(line))

    def verdict(self, reading: Reading) -> Verdict:
        """What it does with a file that it has read; a crash is a refusal."""
        if not reading.ok:
            return Verdict.REFUSES
        return Verdict.WARNS if self.remarks(reading) else Verdict.ACCEPTS

    def ask(self, path: Path) -> Reading:
        """Its reading of a file."""
        return self.reader.ask(path)


_NAMED: Mapping[str, Reader] = {reader.name: reader for reader in (*READERS, *SCENES)}


def _loader(profile: str, reader: str, remark: str) -> Loader:
    return Loader(profile, _NAMED[reader], re.compile(remark))


LOADERS = (
    _loader("urdfdom", "urdfdom", _URDFDOM),
    _loader("gazebo", "libsdformat", r"^(?:Error|Warning)(?: \[|: )"),
    _loader("dart", "dart", r"^(?:Error|Warning)\b|\[warning\]"),
    _loader("drake", "drake with a scene", r"^(?:WARNING|ERROR):drake"),
    _loader("mujoco", "mujoco", r"WARNING"),
    _loader("pinocchio", "pinocchio", _URDFDOM),
    _loader("pybullet", "pybullet", r"b3Warning|b3Error"),
    _loader("yourdfpy", "yourdfpy with a scene", r"."),
    _loader("urdf-parser-py", "urdf_parser_py", r"."),
    _loader("usd", "urdf-usd-converter", r"^(?:Warning|Error)"),
)
"""Those that are asked about every file; a profile that is not among them is not tested."""
