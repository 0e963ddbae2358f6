"""The loaders that profiles describe: which reader stands for which release of a profile, and its verdict on a file."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from testbed.engines.readers.library import OTHERS, READERS, Reader, Reading, elsewhere
from twinform.profiles.profile import release_of, releases_of

_URDFDOM = r"^(?:Error|Warning): "
"""How console_bridge prints what urdfdom finds, for all that are built on it."""


class Verdict(StrEnum):
    """What a loader does with a file."""

    ACCEPTS = "accepts"
    WARNS = "warns"
    REFUSES = "refuses"


@dataclass(frozen=True, slots=True)
class Loader:
    """A reader as the consumer of a profile in a release: `remark` finds the lines of its messages that are warnings.

    `package` is what has to be installed in a folder of its own, with its version, where the environment's is another.
    """

    profile: str
    release: str
    reader: Reader
    remark: re.Pattern[str]
    package: tuple[str, str] | None = None

    @property
    def consumer(self) -> str:
        """The profile with the release, as `--for` takes it."""
        return f"{self.profile}@{self.release}"

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


_NAMED: Mapping[str, Reader] = {reader.name: reader for reader in (*READERS, *OTHERS)}


def _loaders(profile: str, reader: str, remark: str, package: str = "", otherwise: str = "") -> Iterator[Loader]:
    """A loader for each release that a profile was seen in.

    The environment's reader, if there is one, is the release of its version, and otherwise the newest. The others are
    releases of the `package`, and asked by the function `otherwise` where that is another one.
    """
    seen, usual = [each for each in releases_of(profile) if each.seen], _NAMED[reader]
    here = seen[-1] if usual.version() or not package else None
    own = next((each for each in seen if each.seen == usual.version()), here)
    for each in seen:
        other = None if each is own else (package, each.seen)
        found = elsewhere(usual, *other, otherwise) if other else usual
        yield Loader(profile, each.name, found, re.compile(remark), other)


LOADERS = (
    *_loaders("urdfdom", "urdfdom", _URDFDOM, "cmeel-urdfdom", "check_urdf"),
    *_loaders("gazebo", "libsdformat", r"^(?:Error|Warning)(?: \[|: )"),
    *_loaders("dart", "dart", r"^(?:Error|Warning)\b|\[warning\]"),
    *_loaders("drake", "drake with a scene", r"^(?:WARNING|ERROR):drake", "drake"),
    *_loaders("mujoco", "mujoco", r"WARNING", "mujoco"),
    *_loaders("newton", "newton", r"Warning:", "newton"),
    *_loaders("pinocchio", "pinocchio", _URDFDOM, "pin"),
    *_loaders("pybullet", "pybullet", r"b3Warning|b3Error"),
    *_loaders("yourdfpy", "yourdfpy with a scene", r"."),
    *_loaders("urdf-parser-py", "urdf_parser_py", r"."),
    *_loaders("usd", "urdf-usd-converter", r"^(?:Warning|Error)"),
)
"""Those that are asked about every file; a profile that is not among them is not tested."""


def _usual() -> Iterator[Loader]:
    for profile in dict.fromkeys(loader.profile for loader in LOADERS):
        found = [loader for loader in LOADERS if loader.profile == profile]
        yield next((loader for loader in found if loader.release == release_of(profile).name), found[0])


USUAL = tuple(_usual())
"""One for each profile: the release that is meant by default, or else the oldest that was seen."""
