"""Converters from URDF to USD in several releases, each in a folder and a process of its own."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from testbed.engines.readers.install import install
from testbed.engines.readers.installed import folder_of, version_in

_SCRIPT = Path(__file__).with_name("run_converter.py")
_SECONDS = 120
_LONGEST = 160
_ERROR = re.compile(r"^\w+Error: .*\Z", re.MULTILINE | re.DOTALL)
"""The last line of a traceback, and all behind it."""


class RefusedError(Exception):
    """A converter makes nothing of a file; the message is its own."""


@dataclass(frozen=True, slots=True)
class Converter:
    """A release of a converter."""

    package: str
    version: str

    @property
    def name(self) -> str:
        """What it is called in tables."""
        return f"{self.package} {self.version}"

    @property
    def is_here(self) -> bool:
        """Whether it is installed."""
        return bool(version_in(folder_of(self.package, self.version), self.package))

    def convert(self, urdf: Path, folder: Path) -> Path:
        """Make the stage of a file in a folder, which is emptied before.

        Raises:
            RefusedError: it makes none.
        """
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        command = [sys.executable, "-S", str(_SCRIPT), self.package, str(urdf), str(folder)]
        environment = os.environ | {"PYTHONPATH": str(folder_of(self.package, self.version))}
        try:
            done = subprocess.run(
                command, env=environment, capture_output=True, text=True, timeout=_SECONDS, check=False
            )
        except subprocess.TimeoutExpired as error:
            raise RefusedError(f"it came to no end within {_SECONDS} seconds") from error
        made = Path((done.stdout.splitlines() or [""])[-1])
        if done.returncode or not made.is_file():
            said = _ERROR.findall(done.stderr) or [f"it ended with {done.returncode}"]
            raise RefusedError(" ".join(said[-1].split()).replace(str(urdf), "FILE")[:_LONGEST])
        return made


CONVERTERS = (
    *(Converter("urdf-usd-converter", version) for version in ("0.1.0", "0.2.0", "0.3.0", "0.3.4")),
    *(Converter("mujoco-usd-converter", version) for version in ("0.1.0", "0.4.2", "0.8.0")),
)
NEWEST = CONVERTERS[3]
"""The one in whose stages losses are planted."""
MISSING = "no converter to USD is here: python -m testbed.usd.converters"


def available() -> bool:
    """Whether all converters are installed."""
    return all(each.is_here for each in CONVERTERS)


if __name__ == "__main__":
    for each in CONVERTERS:
        install(each.package, each.version)
