"""The pipes between the process that expands xacro and the compiler.

Messages are lines of JSON; the content of a file follows its line as bytes. In: the task, then an answer for each
question. Out: questions, and at the end what became of the task. Whatever lies outside of this process is behind a
question: where a package is (`find`), what is in a file (`read`), which files match a pattern (`match`), and what an
environment variable contains (`environment`).
"""

import json
import os
from typing import Any, Protocol


class Compiler(Protocol):
    """Who gives tasks, and knows what lies outside of this process."""

    def receive(self) -> dict[str, Any]:
        """The task."""
        ...

    def find(self, uri: str, beside: str) -> str:
        """Where a URI leads that stands in a file.

        Raises:
            NotFoundError: nowhere.
        """
        ...

    def read(self, path: str) -> tuple[str, bytes]:
        """What is in a file, and its name, which is another one where a build puts the file at the given path.

        Raises:
            MissingFileError: there is none.
            NotFoundError: it must not be read.
        """
        ...

    def match(self, pattern: str) -> list[str]:
        """The files that match a pattern.

        Raises:
            NotFoundError: it leads to where nothing must be read.
        """
        ...

    def environment(self, name: str) -> str | None:
        """The value of an environment variable; None where there is none of this name.

        Raises:
            NotFoundError: it must not be read.
        """
        ...


class NotFoundError(Exception):
    """What was asked for is not there, or not for a xacro file."""

    def __init__(self, message: str, advice: str) -> None:
        super().__init__(message)
        self.advice = advice


class AbsentError(NotFoundError):
    """A package is nowhere."""


class TooMuchError(NotFoundError):
    """More was asked for than is answered: nothing of the file is expanded, whatever it has instead."""


class TimeUpError(Exception):
    """The process has used up its time."""


class MissingFileError(OSError):
    """A file that is not there: an include that is optional does without it."""


class WorkerChannel:
    """The pipes that the process was started with; nothing else can use them afterwards."""

    def __init__(self) -> None:
        self.incoming = os.fdopen(os.dup(0), "rb")
        self.outgoing = os.fdopen(os.dup(1), "wb")
        # What the file prints must not end up between the messages.
        nothing = os.open(os.devnull, os.O_RDWR)
        for descriptor in (0, 1):
            os.dup2(nothing, descriptor)
        self.known: dict[tuple[str, ...], Any] = {}

    def send(self, message: dict[str, Any]) -> None:
        """Show a text."""
        self.outgoing.write(json.dumps(message).encode() + b"\n")
        self.outgoing.flush()

    def receive(self) -> dict[str, Any]:
        """Hear something."""
        return json.loads(self.incoming.readline())

    def _ask(self, question: dict[str, Any]) -> dict[str, Any]:
        self.send(question)
        answer = self.receive()
        if "missing" in answer:
            raise MissingFileError(answer["missing"])
        if "error" in answer:
            refusal = TooMuchError if answer.get("ends") else AbsentError if answer.get("absent") else NotFoundError
            raise refusal(answer["error"], answer["help"])
        return answer

    def find(self, uri: str, beside: str) -> str:
        """Ask where a URI leads that stands in a file."""
        return self._ask_once({"find": uri, "beside": beside}, "path")

    def read(self, path: str) -> tuple[str, bytes]:
        """Ask for what is in a file, and where that is."""
        try:
            answer = self._ask({"read": path})
        except MissingFileError as error:
            raise MissingFileError(f"cannot read {path!r}: {error}") from error
        return answer["path"], self.incoming.read(answer["size"])

    def match(self, pattern: str) -> list[str]:
        """Ask which files match a pattern."""
        return self._ask_once({"match": pattern}, "paths")

    def environment(self, name: str) -> str | None:
        """Ask for the value of an environment variable."""
        return self._ask_once({"environment": name}, "value")

    def _ask_once(self, question: dict[str, str], wanted: str) -> Any:
        """Ask what has the same answer as long as the process lives."""
        key = tuple(question.values())
        if key not in self.known:
            self.known[key] = self._ask(question)[wanted]
        return self.known[key]
