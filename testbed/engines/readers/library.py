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
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from testbed.engines.readers import parsers
from testbed.engines.readers.answers import Kept
from testbed.engines.readers.installed import folder_of, import_path, python_for, version_in
from twinform.testing.oracles import libsdformat

_ROOT = Path(__file__).parents[3]
_COLOR = re.compile(r"\x1b\[[0-9;]*m")
_PASSING = re.compile(r"0x[0-9a-f]+|\d{4}-\d\d-\d\d[ T][\d:.,]+|/tmp/\w+|[Ll]ine \d+|:L?\d+\b")
"""What differs from one call to the next, and between a file and the same with lines left out."""
_EXTRA = "pip install 'twinform[readers]'"
_NPM = f"npm install urdf-loader three jsdom, with their node_modules in {parsers.NODE_MODULES}"


@dataclass(frozen=True, slots=True)
class Reading:
    """Whether a reader accepts a file, why not, all its messages on it, and what it keeps, where it tells."""

    error: str
    output: str
    kept: Kept | None = None

    @property
    def ok(self) -> bool:
        """Whether it took the file."""
        return not self.error

    @property
    def crashed(self) -> bool:
        """Whether it ended its process, or came to no end."""
        return self.error.startswith("crash: ")


@dataclass(slots=True, eq=False)
class Reader:
    """A reader: its formats by suffix, what it needs to be here, and its release.

    `python` runs it with `path` as PYTHONPATH: those of the environment, or of a release that is installed elsewhere.
    """

    name: str
    formats: frozenset[str]
    needs: str
    present: Callable[[], bool]
    version: Callable[[], str]
    python: str = sys.executable
    path: str = str(_ROOT)
    _process: subprocess.Popen[str] | None = field(default=None, init=False)

    def ask(self, path: Path) -> Reading:
        """Its verdict on a file, what it prints and keeps; its process is started with the first one."""
        path = path.resolve()
        row = self._answer(path) or self._answer(path)  # a process that somebody ended is started again, once
        if row is None:
            return Reading("crash: its process ended", "")
        kept = row["kept"]
        if kept is not None:
            kept = Kept(tuple(kept["links"]), tuple(kept["joints"]), kept["masses"], kept["shapes"])
        return Reading(_lasting(row["error"], path), _lasting(f"{row['output']}\n{row['console']}", path), kept)

    def close(self) -> None:
        """End its process, if there is one."""
        if self._process is not None:
            process, self._process = self._process, None
            process.communicate()

    def _answer(self, path: Path) -> dict[str, Any] | None:
        """Its row for a file; None where its process is gone."""
        process = self._process = self._process or self._started()
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            print(path, file=process.stdin, flush=True)
            line = process.stdout.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            process.kill()
            self.close()
            return None
        return json.loads(line)

    def _started(self) -> subprocess.Popen[str]:
        command = [self.python, "-m", "testbed.engines.readers.child", self.name]
        environment = os.environ | {"PYTHONPATH": self.path}
        quiet, folder = subprocess.DEVNULL, tempfile.gettempdir()  # some leave a log where they are
        return subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=quiet,
            text=True,
            cwd=folder,
            env=environment,
        )


def _lasting(text: str, path: Path) -> str:
    """The messages of a reader, without what changes from run to run."""
    plain = (
        _COLOR.sub("", text).replace(str(path), "FILE").replace(path.name, "FILE").replace(str(path.parent), "FOLDER")
    )
    return "\n".join(dict.fromkeys(line for line in _PASSING.sub("", plain).splitlines() if line.strip()))


def _importable(module: str) -> bool:
    return find_spec(module) is not None


def _released(package: str) -> str:
    """The version of a package of Python; empty where it is not here."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def _packaged(package: str) -> str:
    """The version of a package of Debian, as its authors count; empty where it is not here."""
    if shutil.which("dpkg-query") is None:
        return ""
    command = ["dpkg-query", "--show", "--showformat=${Version}", package]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.partition("-")[0].partition("+")[0]


def _npm() -> bool:
    return shutil.which("node") is not None and Path(os.environ.get(parsers.NODE_MODULES, "."), "urdf-loader").is_dir()


_URDF, _BOTH = frozenset({".urdf"}), frozenset({".urdf", ".sdf"})
_TOOL = "urdfdom: it needs liburdfdom-dev, pkg-config and g++"


def _python(name: str, formats: frozenset[str], module: str, package: str) -> Reader:
    return Reader(name, formats, _EXTRA, partial(_importable, module), partial(_released, package))


READERS = (
    Reader(
        "libsdformat",
        _BOTH,
        libsdformat.MISSING,
        parsers.available_libsdformat,
        partial(_packaged, "libsdformat-dev"),
    ),
    Reader("urdfdom", _URDF, _TOOL, parsers.available_urdfdom, partial(_packaged, "liburdfdom-dev")),
    _python("dart", _URDF, "dartpy", "dartpy"),
    _python("drake", _BOTH, "pydrake", "drake"),
    _python("mujoco", _URDF, "mujoco", "mujoco"),
    _python("pinocchio", _URDF, "pinocchio", "pin"),
    _python("pybullet", _BOTH, "pybullet", "pybullet"),
    _python("yourdfpy", _URDF, "yourdfpy", "yourdfpy"),
    _python("urdf_parser_py", _URDF, "urdf_parser_py", "urdf_parser_py"),
    _python("urchin", _URDF, "urchin", "urchin"),
    _python("urdf-usd-converter", _URDF, "urdf_usd_converter", "urdf-usd-converter"),
    Reader("urdf-loader", _URDF, _NPM, _npm, str),
    _python("xacro", _URDF, "xacro", "xacro"),
    _python("lxml", _BOTH, "lxml", "lxml"),
)
OTHERS = (
    _python("newton", _URDF, "newton", "newton"),
    _python("drake with a scene", _BOTH, "pydrake", "drake"),
    _python("yourdfpy with a scene", _URDF, "yourdfpy", "yourdfpy"),
)
"""Those that profiles are about alone: Newton, and two that look at shapes and materials, and so need meshes."""


def elsewhere(reader: Reader, package: str, version: str, name: str = "") -> Reader:
    """A reader in a release of a package that has a folder of its own; `name` where another function asks it."""
    folder, python = folder_of(package, version), python_for(package, version)
    present = partial(_is_in, folder, package, python)
    needs = "python -m testbed.engines.readers.install"
    path = import_path(folder)
    return Reader(name or reader.name, reader.formats, needs, present, lambda: version, python or "", path)


def _is_in(folder: Path, package: str, python: str | None) -> bool:
    return python is not None and bool(version_in(folder, package))
