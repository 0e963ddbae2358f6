"""Protocol with the process that expands xacro, on the compiler's side: a task, questions and answers, a result."""

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from threading import Timer
from typing import Any, Self, cast

from twinform.compiler.input.limits import LARGEST
from twinform.compiler.input.xacro.files import Files, OutsideError
from twinform.compiler.input.xacro.variables import variable
from twinform.compiler.search.search_roots import folders_around
from twinform.compiler.search.uris import SearchPath, UriError

_WORKER = Path(__file__).with_name("worker") / "__main__.py"
_SECONDS = 60
"""Of the clock, on a machine that is busy; the worker itself has 10 of the processor."""
_LONGEST_MESSAGE = 4 * LARGEST
_QUESTIONS = frozenset({"environment", "find", "match", "read"})
_PASSED_ON = ("APPDATA", "HOME", "LANG", "PATH", "SYSTEMROOT", "TEMP", "TMPDIR", "USERPROFILE")
_PASSED_ON_STARTS = ("COV", "DYLD_", "LC_", "LD_", "PYTHON")
"""What Python needs of the environment to find its modules; the rest is not in the process at all."""


def ask_worker(path: Path, arguments: Mapping[str, str], search: SearchPath) -> dict[str, Any]:
    """What becomes of a file in a process of its own."""
    # -P: the folder of the script is no place to import from. -W: what Python warns of is not the file's to know
    command = [sys.executable, "-P", "-W", "ignore", str(_WORKER)]
    pipe = subprocess.PIPE
    with subprocess.Popen(  # noqa: S603 - our own script, and no shell
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=environment()
    ) as process:
        timer = Timer(_SECONDS, process.kill)
        timer.start()
        try:
            return _Conversation.of(path, search).hold(process, {"file": str(path), "arguments": dict(arguments)})
        finally:
            timer.cancel()
            process.kill()


def environment() -> dict[str, str]:
    """The environment of the process."""
    passed_on = {
        name: value for name, value in os.environ.items() if name in _PASSED_ON or name.startswith(_PASSED_ON_STARTS)
    }
    # what is written from a set has the same order each time
    return {**passed_on, "PYTHONHASHSEED": "0", "PYTHONIOENCODING": "utf-8"}


class _Conversation:
    """Answers the questions of the process."""

    def __init__(self, path: Path, search: SearchPath, files: Files) -> None:
        self.path = path
        self.search = search
        self.files = files

    @classmethod
    def of(cls, path: Path, search: SearchPath) -> Self:
        """With the folders whose files may be read: those around the file, and those of the search path."""
        folders = (path.parent, *search.own, *folders_around(path))
        trusted = (*search.models, *search.packages, *search.workspaces)
        files = Files.of([str(path)], map(str, (*folders, *trusted)), map(str, trusted))
        return cls(path, search, files)

    def hold(self, process: subprocess.Popen[bytes], task: Mapping[str, object]) -> dict[str, Any]:
        """Give the task and answer, until the process sends the result."""
        to_worker, from_worker = process.stdin, process.stdout
        message, content = task, b""
        try:
            while to_worker and from_worker:
                to_worker.write(json.dumps(message).encode() + b"\n" + content)
                to_worker.flush()
                said = _understood(from_worker.readline(_LONGEST_MESSAGE))
                if not said:
                    break
                if not _QUESTIONS.intersection(said):
                    return said
                message, content = self._answer(said)
        except BrokenPipeError:
            pass  # it died before it could listen
        return {"error": "the expansion died, or did not end within its time", "place": (str(self.path), 1)}

    def _answer(self, said: Mapping[str, str]) -> tuple[Mapping[str, object], bytes]:
        try:
            match said:
                case {"find": uri, "beside": beside}:
                    return self._find(uri, (Path(beside), self.path)), b""
                case {"read": path}:
                    content = self.files.read(path)
                    return {"size": len(content)}, content
                case {"match": pattern}:
                    return {"paths": self.files.match(pattern)}, b""
                case _:
                    return {"value": variable(said["environment"], os.environ)}, b""
        except OutsideError as error:
            return {"error": str(error), "help": error.advice}, b""
        except (OSError, ValueError) as error:
            return {"missing": getattr(error, "strerror", None) or str(error)}, b""

    def _find(self, uri: str, files: Iterable[Path]) -> dict[str, str]:
        """Where a URI leads from the first of the files from which it leads anywhere."""
        answer: dict[str, str] = {}
        for file in files:
            try:
                return {"path": str(self.search.find(uri, file).absolute())}  # links keep their names
            except UriError as error:
                answer = {"error": error.message, "help": error.help or ""}
        return answer


def _understood(line: bytes) -> dict[str, Any]:
    """A message; nothing where the process died while it spoke."""
    try:
        said: object = json.loads(line)
    except ValueError:
        return {}
    return cast("dict[str, Any]", said) if isinstance(said, dict) else {}
