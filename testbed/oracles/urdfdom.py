"""What urdfdom, the parser of ROS, reports on a file: the system's release, and release 6, which reads URDF 1.2."""

import os
import shutil
import subprocess
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

MISSING = "urdfdom is not here: it needs check_urdf of liburdfdom-tools"
MISSING_6 = "urdfdom 6 is not here: pip install '.[engines]'"


def available() -> bool:
    """Whether the tool of the system is installed."""
    return shutil.which("check_urdf") is not None


def available_6() -> bool:
    """Whether the tool of release 6 is installed."""
    return _prefix() is not None


def complaints(path: Path) -> tuple[str, ...]:
    """The error messages of the system's urdfdom; none where it reads the whole file."""
    return _complaints("check_urdf", path, os.environ)


def complaints_of_6(path: Path) -> tuple[str, ...]:
    """The error messages of urdfdom 6; none where it reads the whole file.

    Raises:
        FileNotFoundError: it is not installed.
    """
    prefix = _prefix()
    if prefix is None:
        raise FileNotFoundError(MISSING_6)
    return _complaints(prefix / "bin/check_urdf", path, {**os.environ, "LD_LIBRARY_PATH": str(prefix / "lib")})


def _complaints(program: str | Path, path: Path, environment: Mapping[str, str]) -> tuple[str, ...]:
    # The exit status alone is not enough: after a fault in a link the parser drops the rest of the
    # link, logs that, and calls the file good.
    command = [program, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, errors="replace", env=environment)
    errors = tuple(line.partition("Error:")[2].strip() for line in done.stderr.splitlines() if "Error:" in line)
    if done.returncode and not errors:
        return (f"check_urdf ended with {done.returncode}",)
    return errors


def _prefix() -> Path | None:
    """The folder of the wheel with urdfdom 6, whose own script to run a program is slow to start."""
    try:
        files = distribution("cmeel-urdfdom").files or []
    except PackageNotFoundError:
        return None
    found = (Path(str(file.locate())) for file in files if file.match("cmeel.prefix/bin/check_urdf"))
    return next((each.parent.parent for each in found if each.is_file()), None)
