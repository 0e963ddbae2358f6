"""Files as libsdformat 12 prints them: URDF becomes SDF, with its fixed joints lumped."""

import hashlib
import os
import shutil
import subprocess
from functools import cache
from pathlib import Path

from tests.corpus.files import ROOT

_SOURCE = Path(__file__).with_name("sdf_print.cpp")
_BUILD = ROOT / "build" / "sdf_print"
_SECONDS = 20


@cache
def available() -> bool:
    """Whether the library and the tools to build against it are installed."""
    if not (shutil.which("pkg-config") and shutil.which("g++")):
        return False
    return subprocess.run(["pkg-config", "--exists", "sdformat12"], check=False).returncode == 0


def printed(path: Path) -> str | None:
    """A file as the library prints it; None where it does not read it, or does not survive it."""
    try:
        done = subprocess.run([str(_program()), str(path)], capture_output=True, check=False, timeout=_SECONDS)
    except subprocess.TimeoutExpired:
        return None
    return done.stdout.decode(errors="replace") if done.returncode == 0 and done.stdout else None


@cache
def _program() -> Path:
    program = _BUILD / f"sdf_print-{hashlib.sha256(_SOURCE.read_bytes()).hexdigest()[:12]}"
    if not program.exists():
        _build(program)
    return program


def _build(program: Path) -> None:
    program.parent.mkdir(parents=True, exist_ok=True)
    query = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    flags = subprocess.run(query, capture_output=True, text=True, check=True).stdout.split()
    own = program.with_name(f"{program.name}.{os.getpid()}")  # several processes may build at the same time
    subprocess.run(["g++", "-O1", "-std=c++17", str(_SOURCE), "-o", str(own), *flags], check=True)
    own.replace(program)
