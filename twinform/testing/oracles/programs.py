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
    """A program by its source, with the packages of pkg-config that it is built against.

    Headers that it includes by a relative path belong to it: whatever of them changes, the program is built again.
    """

    source: Path
    packages: tuple[str, ...]

    def can_be_built(self) -> bool:
        """Whether the libraries and the tools to build against them are installed."""
        return _installed(self.packages)

    def built(self) -> Path:
        """The program, which is built where it is not there yet.

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
    path = _folder() / f"{program.source.stem}-{_digest(program)}"
    if not path.exists():
        _build(program, path)
    return path


def _digest(program: Program) -> str:
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in sources(program.source))).hexdigest()[:12]


def sources(path: Path, known: tuple[Path, ...] = ()) -> tuple[Path, ...]:
    """A source with the headers that it includes by relative paths, and those that they include, once each."""
    if path in known:
        return known
    known = (*known, path)
    for name in _INCLUDE.findall(path.read_text(encoding="utf-8")):
        known = sources((path.parent / name).resolve(), known)
    return known


def _folder() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "twinform" / "oracles"


def _build(program: Program, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", *program.packages], capture_output=True, text=True, check=True
    ).stdout.split()
    # two test processes may build at the same time: each builds its own, and the last one wins
    own = path.with_name(f"{path.name}.{os.getpid()}")
    subprocess.run(["g++", "-O1", "-std=c++17", str(program.source), "-o", str(own), *flags], check=True)
    own.replace(path)
