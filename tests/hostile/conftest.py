"""What the watched processes need of the machine."""

import compileall
from pathlib import Path

import pytest

import twinform


@pytest.fixture(scope="session", autouse=True)
def compiled() -> None:
    """The bytecode of the package: a process that may write nothing would compile it anew each time."""
    compileall.compile_dir(Path(twinform.__file__).parent, quiet=1)
