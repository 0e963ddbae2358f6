"""Readers in other releases than the environment has: each is installed in a folder of its own below `out/readers`.

A package that needs a newer Python than ours is run by one that is on the path.
"""

import os
import shutil
import sys
from collections.abc import Mapping
from importlib.metadata import PathDistribution, distributions
from pathlib import Path

from testbed.output_files import OUT

_ROOT = Path(__file__).parents[3]
_PYTHONS: Mapping[str, str] = {f"drake==1.{minor}": "3.13" for minor in range(52, 59)}
"""The version of Python that a package needs, by how its requirement begins."""


def folder_of(package: str, version: str) -> Path:
    """Where a package is in a version."""
    return OUT / "readers" / f"{package}-{version}"


def version_in(folder: Path, package: str) -> str:
    """The version of a package that is in a folder; empty where it is not there."""
    found = (each for each in distributions(path=[str(folder)]) if isinstance(each, PathDistribution))
    return next((each.version for each in found if each.metadata["Name"] == package), "")


def python_for(package: str, version: str) -> str | None:
    """The program of Python that runs a package; None where it is not on the path."""
    wanted = python_version_of(f"{package}=={version}")
    return shutil.which(f"python{wanted}") if wanted else sys.executable


def import_path(folder: Path) -> str:
    """The value of PYTHONPATH with which Python imports what is in a folder."""
    # wheels of cmeel have all in a prefix, which a .pth file names that is read in environments only
    inside = sorted(folder.glob("cmeel.prefix/lib/python*/site-packages"))
    return os.pathsep.join(map(str, (_ROOT, folder, *inside)))


def python_version_of(requirement: str) -> str:
    """The version of Python that a package needs; empty where ours will do."""
    return next((wanted for begin, wanted in _PYTHONS.items() if requirement.startswith(f"{begin}.")), "")
