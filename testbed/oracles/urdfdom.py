"""What urdfdom, the parser of ROS, reports on a file."""

import shutil
import subprocess
from pathlib import Path

MISSING = "urdfdom is not here: it needs check_urdf of liburdfdom-tools"


def available() -> bool:
    """Whether its tool is installed."""
    return shutil.which("check_urdf") is not None


def complaints(path: Path) -> tuple[str, ...]:
    """Its error messages; none where it reads the whole file.

    The exit status alone is not enough: after a fault in a link the parser drops the rest of the link, logs that, and
    calls the file good.
    """
    done = subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False, errors="replace")
    errors = tuple(line.partition("Error:")[2].strip() for line in done.stderr.splitlines() if "Error:" in line)
    if done.returncode and not errors:
        return (f"check_urdf ended with {done.returncode}",)
    return errors
