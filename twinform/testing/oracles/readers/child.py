"""A process around one reader: paths on standard input, a JSON line for each on standard output.

Every file is read by a fork of it, so that a reader that crashes, or keeps state, spoils no other file.
"""

import json
import os
import signal
import sys
from pathlib import Path

from twinform.testing.oracles.readers.functions import FUNCTIONS, prepare

SECONDS = 30


def main(name: str) -> None:
    """Serve until standard input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a module prints while it is imported is no answer
    prepare(name)
    for line in sys.stdin:
        json.dump(_ask(name, Path(line.rstrip("\n"))), answers)
        print(file=answers, flush=True)


def _ask(name: str, path: Path) -> dict[str, str]:
    answer, console = os.memfd_create("answer"), os.memfd_create("console")
    process = os.fork()
    if process == 0:
        _read(name, path, answer, console)
    _, status = os.waitpid(process, 0)
    ended = os.waitstatus_to_exitcode(status)
    outcome = _contents(answer) if ended == 0 else json.dumps({"error": f"ended with {ended}", "output": ""})
    return {**json.loads(outcome), "console": _contents(console)}


def _read(name: str, path: Path, answer: int, console: int) -> None:
    """Read the file in the fork, and end it."""
    signal.alarm(SECONDS)
    os.dup2(console, 1)
    os.dup2(console, 2)
    try:
        result = {"error": "", "output": FUNCTIONS[name](path)}
    except (Exception, SystemExit) as error:  # noqa: BLE001  whatever a reader throws, it refuses the file
        result = {"error": f"{type(error).__name__}: {error}", "output": ""}
    sys.stdout.flush()
    sys.stderr.flush()
    os.write(answer, json.dumps(result).encode())
    os._exit(0)


def _contents(file: int) -> str:
    size = os.lseek(file, 0, os.SEEK_END)
    text = os.pread(file, size, 0).decode(errors="replace")
    os.close(file)
    return text


if __name__ == "__main__":
    main(sys.argv[1])
