"""A process around one reader: paths on standard input, a JSON line for each on standard output.

Every file is read by a fork of it, so that a reader that crashes, hangs or keeps state spoils no other file.
"""

import json
import os
import signal
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from testbed.engines.readers.functions import FUNCTIONS, prepare

SECONDS = 30
"""Of its own time: on a busy machine a large file waits longer than this."""


def main(name: str) -> None:
    """Serve until standard input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a module prints while it is imported is no answer
    prepare(name)
    for line in sys.stdin:
        json.dump(_ask(name, Path(line.rstrip("\n"))), answers)
        print(file=answers, flush=True)


def _ask(name: str, path: Path) -> dict[str, Any]:
    answer, console = os.memfd_create("answer"), os.memfd_create("console")
    process = os.fork()
    if process == 0:
        _read(name, path, answer, console)
    _, status = os.waitpid(process, 0)
    ended = os.waitstatus_to_exitcode(status)
    outcome: dict[str, Any] = json.loads(_contents(answer) or "{}") if ended == 0 else {"error": _ending(ended)}
    return {"output": "", "kept": None, **outcome, "console": _contents(console)}


def _ending(status: int) -> str:
    if status in {-signal.SIGPROF, -signal.SIGALRM}:
        return f"crash: it came to no end within {SECONDS} seconds"
    return f"crash: ended with {signal.Signals(-status).name if status < 0 else status}"


def _read(name: str, path: Path, answer: int, console: int) -> None:
    """Read the file in the fork, and end it."""
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    signal.alarm(10 * SECONDS)
    os.dup2(console, 1)
    os.dup2(console, 2)
    try:
        result = {"error": "", **asdict(FUNCTIONS[name](path))}
    except (Exception, SystemExit) as error:  # noqa: BLE001  whatever a reader throws, it refuses the file
        result = {"error": f"{type(error).__name__}: {error}"}
    sys.stdout.flush()
    sys.stderr.flush()
    with os.fdopen(answer, "wb") as file:
        file.write(json.dumps(result).encode(errors="replace"))
    os._exit(0)


def _contents(file: int) -> str:
    size = os.lseek(file, 0, os.SEEK_END)
    text = os.pread(file, size, 0).decode(errors="replace")
    os.close(file)
    return text


if __name__ == "__main__":
    main(sys.argv[1])
