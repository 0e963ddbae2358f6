"""The readers that can be asked, what each of them reads, and a process for each."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.readers.functions import NODE_MODULES

_COLOR = re.compile(r"\x1b\[[0-9;]*m")
_PASSING = re.compile(r"0x[0-9a-f]+|\d{4}-\d\d-\d\d[ T][\d:.,]+|/tmp/\w+|[Ll]ine \d+|:L?\d+\b")
"""What differs from one call to the next, and between a file and the same with lines left out."""
_EXTRA = "pip install 'twinform[readers]'"
_NPM = f"npm install urdf-loader three jsdom, with their node_modules in {NODE_MODULES}"


@dataclass(frozen=True, slots=True)
class Reading:
    """Whether a reader accepts a file, why not, and all its messages on it."""

    error: str
    output: str

    @property
    def ok(self) -> bool:
        """Whether it took the file."""
        return not self.error


@dataclass(slots=True)
class Reader:
    """A reader: its formats by suffix, and what it needs to be here."""

    name: str
    formats: frozenset[str]
    needs: str
    present: Callable[[], bool]
    _process: subprocess.Popen[str] | None = field(default=None, init=False)

    def ask(self, path: Path) -> Reading:
        """Its verdict on a file, and what it prints; its process is started with the first one."""
        if self._process is None:
            command = [sys.executable, "-m", "twinform.testing.oracles.readers.child", self.name]
            quiet, folder = subprocess.DEVNULL, tempfile.gettempdir()  # some leave a log where they are
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=quiet, text=True, cwd=folder
            )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        print(path.resolve(), file=self._process.stdin, flush=True)
        row: dict[str, str] = json.loads(self._process.stdout.readline())
        return Reading(
            _lasting(row["error"], path.resolve()), _lasting(f"{row['output']}\n{row['console']}", path.resolve())
        )

    def close(self) -> None:
        """End its process, if there is one."""
        if self._process is not None:
            self._process.communicate()
            self._process = None


def _lasting(text: str, path: Path) -> str:
    """The messages of a reader, without what changes from run to run."""
    plain = (
        _COLOR.sub("", text).replace(str(path), "FILE").replace(path.name, "FILE").replace(str(path.parent), "FOLDER")
    )
    return "\n".join(dict.fromkeys(line for line in _PASSING.sub("", plain).splitlines() if line.strip()))


def _importable(module: str) -> bool:
    return find_spec(module) is not None


def _npm() -> bool:
    return shutil.which("node") is not None and Path(os.environ.get(NODE_MODULES, "."), "urdf-loader").is_dir()


_URDF, _BOTH = frozenset({".urdf"}), frozenset({".urdf", ".sdf"})
_TOOL = "check_urdf of liburdfdom-tools"
READERS = (
    Reader("libsdformat", _BOTH, libsdformat.MISSING, libsdformat.available),
    Reader("urdfdom", _URDF, _TOOL, lambda: shutil.which("check_urdf") is not None),
    Reader("drake", _BOTH, _EXTRA, partial(_importable, "pydrake")),
    Reader("mujoco", _URDF, _EXTRA, partial(_importable, "mujoco")),
    Reader("pinocchio", _URDF, _EXTRA, partial(_importable, "pinocchio")),
    Reader("pybullet", _BOTH, _EXTRA, partial(_importable, "pybullet")),
    Reader("yourdfpy", _URDF, _EXTRA, partial(_importable, "yourdfpy")),
    Reader("urdf_parser_py", _URDF, _EXTRA, partial(_importable, "urdf_parser_py")),
    Reader("urchin", _URDF, _EXTRA, partial(_importable, "urchin")),
    Reader("urdf-usd-converter", _URDF, _EXTRA, partial(_importable, "urdf_usd_converter")),
    Reader("urdf-loader", _URDF, _NPM, _npm),
    Reader("xacro", _URDF, _EXTRA, partial(_importable, "xacro")),
    Reader("lxml", _BOTH, "lxml", partial(_importable, "lxml")),
)
