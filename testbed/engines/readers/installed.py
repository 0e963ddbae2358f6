"""Readers in other releases than the environment has: each is installed in a folder of its own below `out/readers`.

One that needs a newer Python than ours is run by the first newer one that is here.
"""

import os
import shutil
import subprocess
import sys
from functools import cache
from importlib.metadata import PathDistribution, distributions
from pathlib import Path

from testbed.output_files import OUT

_ROOT = Path(__file__).parents[3]
# Drake has wheels for 3.12 and newer alone from 1.52 on.
_NEED_NEWER = tuple(f"drake==1.{minor}." for minor in range(52, 60))
_NEWER = ("python3.12", "python3.13", "python3.14")


def folder_of(package: str, version: str) -> Path:
    """Where a package is in a version."""
    return OUT / "readers" / f"{package}-{version}"


def version_in(folder: Path, package: str) -> str:
    """The version of a package that is in a folder; empty where it is not there."""
    found = (each for each in distributions(path=[str(folder)]) if isinstance(each, PathDistribution))
    return next((each.version for each in found if each.metadata["Name"] == package), "")


def python_for(package: str, version: str) -> str | None:
    """The program of Python that runs a package; None where there is none."""
    if sys.version_info >= (3, 12) or not f"{package}=={version}".startswith(_NEED_NEWER):
        return sys.executable
    return _newer_python()


@cache
def _newer_python() -> str | None:
    """The first newer Python that runs: on the path, or one of pyenv, whose command on the path may only be a hint."""
    of_pyenv = (str(each) for name in _NEWER for each in sorted(Path.home().glob(f".pyenv/versions/*/bin/{name}")))
    found = (*filter(None, map(shutil.which, _NEWER)), *of_pyenv)
    return next((each for each in found if _runs(each)), None)


def _runs(program: str) -> bool:
    return subprocess.run([program, "-c", ""], check=False, capture_output=True).returncode == 0


def import_path(folder: Path) -> str:
    """The value of PYTHONPATH with which Python imports what is in a folder."""
    # wheels of cmeel have all in a prefix, which a .pth file names that is read in environments only
    inside = sorted(folder.glob("cmeel.prefix/lib/python*/site-packages"))
    return os.pathsep.join(map(str, (_ROOT, folder, *inside)))
