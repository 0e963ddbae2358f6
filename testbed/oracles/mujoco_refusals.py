"""What MuJoCo has against files of MJCF, asked in a process of its own, which a file may end."""

import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

_ASK = """
import json, sys
import mujoco
for path in sys.argv[1:]:
    try:
        mujoco.MjModel.from_xml_path(path)
    except ValueError as error:
        print(json.dumps([path, str(error)]))
    else:
        print(json.dumps([path, ""]))
"""
_AT_ONCE = 100


def refusals(paths: Sequence[Path]) -> Iterator[tuple[Path, str]]:
    """Yield each file with the reason why MuJoCo refuses it, or with nothing.

    Raises:
        subprocess.CalledProcessError: MuJoCo ended the process.
    """
    for start in range(0, len(paths), _AT_ONCE):
        command = [sys.executable, "-c", _ASK, *map(str, paths[start : start + _AT_ONCE])]
        # it writes a log where it stands
        done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=paths[0].parent)
        for line in done.stdout.splitlines():
            if line.startswith("["):
                path, reason = json.loads(line)
                yield Path(path), reason
