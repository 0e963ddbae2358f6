"""Files as libsdformat 12 prints them: URDF becomes SDF, with its fixed joints lumped."""

import subprocess
from pathlib import Path

from twinform.testing.oracles.libsdformat import Program

_PRINT = Program(Path(__file__).with_name("sdf_print.cpp"), ("sdformat12",))
_SECONDS = 20
available = _PRINT.can_be_built


def printed(path: Path) -> str | None:
    """A file as the library prints it; None where it does not read it, or does not survive it."""
    try:
        done = subprocess.run([_PRINT.built(), path], capture_output=True, check=False, timeout=_SECONDS)
    except subprocess.TimeoutExpired:
        return None
    return done.stdout.decode(errors="replace") if done.returncode == 0 and done.stdout else None
