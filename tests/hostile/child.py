"""The command in a process that is watched: little time and memory, nothing to write, and every file it opens noted."""

import json
import os
import resource
import subprocess
import sys
import sysconfig
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.profile import DEEP

MEMORY = 512 * 2**20
SECONDS = 2 if DEEP else 4
"""Of processor time. `make prove` holds what is promised; the quick tests must not fail where a machine is slow."""
_OWN = (sys.prefix, sys.base_prefix, sysconfig.get_path("stdlib"), str(Path(__file__).parents[2] / "twinform"), "/proc")
_WATCHED = """
import json, os, sys
seen = set()
def hook(event, arguments):
    if event == "open" and not isinstance(arguments[0], int):
        seen.add(os.path.realpath(os.fsdecode(arguments[0])))
sys.addaudithook(hook)
from twinform.cli import main
try:
    main(sys.argv[1:])
finally:
    print(json.dumps(sorted(seen)), file=sys.stderr)
"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What the command said, how it ended, and the files that it opened besides the program's own."""

    code: int
    said: str
    opened: frozenset[str]


def twinform(*words: str | Path, folder: Path, seconds: int = SECONDS) -> Outcome:
    """Run the command where it may write nothing at all."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    command = [sys.executable, "-B", "-c", _WATCHED, *map(str, words)]
    # a process that may not write cannot be measured either
    environment = {name: value for name, value in os.environ.items() if not name.startswith("COV")}
    done = subprocess.run(command, cwd=folder, capture_output=True, preexec_fn=limit, env=environment, check=False)
    *lines, last = done.stderr.decode(errors="replace").splitlines() or [""]
    opened: list[str] = json.loads(last) if last.startswith("[") else []
    said = done.stdout.decode(errors="replace") + "\n".join([*lines, "" if last.startswith("[") else last])
    return Outcome(done.returncode, said, frozenset(each for each in opened if not _is_own(each)))


def _is_own(path: str) -> bool:
    return path == os.devnull or any(path.startswith(os.path.realpath(each)) for each in _OWN)


def rules(said: str, severity: str = "error") -> Sequence[str]:
    """The rules of the findings of a severity, in the order in which they were printed."""
    lines = [line for line in said.splitlines() if f": {severity}: " in line and line.endswith("]")]
    return [line.rpartition("[")[2].rstrip("]") for line in lines]
