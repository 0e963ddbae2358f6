"""C++ programs around the libraries that judge: built with g++ on first use, and kept in the user's cache."""

import hashlib
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Program:
    """A program: its source, and the packages of pkg-config that it is built against.

    It is built again when the source changes, or a header that the source includes by a relative path.
    """

    source: Path
    packages: tuple[str, ...]

    def can_be_built(self) -> bool:
        """Whether the libraries and the tools to build against them are installed."""
        return _installed(self.packages)

    def built(self) -> Path:
        """Return the path of the program, and build it first if it is not there yet.

        Raises:
            CalledProcessError: it does not build.
        """
        return _built(self)


@cache
def _installed(packages: tuple[str, ...]) -> bool:
    if not (shutil.which("pkg-config") and shutil.which("g++")):
        return False
    return subprocess.run(["pkg-config", "--exists", *packages], check=False).returncode == 0


@cache
def _built(program: Program) -> Path:
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources(program.source))).hexdigest()
    folder = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "twinform", "oracles")
    path = folder / f"{program.source.stem}-{digest[:12]}"
    if not path.exists():
        _build(program, path)
    return path


def sources(path: Path, known: tuple[Path, ...] = ()) -> tuple[Path, ...]:
    """Return a source and all headers that it includes by relative paths, directly or through others."""
    if path in known:
        return known
    known = (*known, path)
    for name in _INCLUDE.findall(path.read_text(encoding="utf-8")):
        known = sources((path.parent / name).resolve(), known)
    return known


def _build(program: Program, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", *program.packages], capture_output=True, text=True, check=True
    ).stdout.split()
    # two test processes may build at the same time: each builds its own, and the last one wins
    own = path.with_name(f"{path.name}.{os.getpid()}")
    subprocess.run(["g++", "-O1", "-std=c++17", str(program.source), "-o", str(own), *flags], check=True)
    own.replace(path)
