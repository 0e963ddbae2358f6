"""The task of the process: expand one file and send the result."""

import io
import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

from twinform.compiler.input.xacro.worker.channel import Compiler, WorkerChannel
from twinform.compiler.input.xacro.worker.expander import Expander
from twinform.compiler.input.xacro.worker.expansion_limits import limit
from twinform.compiler.input.xacro.worker.expressions.budget import ExcessError
from twinform.compiler.input.xacro.worker.failures import description
from twinform.compiler.input.xacro.worker.places import BadFileError, FileLine, places_below
from twinform.confinement import confine
from twinform.confinement.parent import end_with_parent

_MOST_REMARKS = 1000
# Python imports these when it meets certain characters, and could not do so once the process is
# confined.
_NEEDED_LATER = ("unicodedata", "encodings.cp1252", "encodings.iso8859_15", "encodings.utf_16")


class _Arguments(dict[str, str]):
    """Knows which of them were asked for."""

    def __init__(self, given: dict[str, str]) -> None:
        super().__init__(given)
        self.unused = set(given)

    def __contains__(self, name: object) -> bool:
        self.unused.discard(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.unused.discard(name)
        return super().__getitem__(name)


class _Remarks(io.StringIO):
    """What xacro and the file print, line by line with the place where they did."""

    def __init__(self, where: Callable[[], FileLine]) -> None:
        super().__init__()
        self.where = where
        self.found: dict[tuple[str, FileLine], None] = {}
        self.begun = ""

    def write(self, text: str) -> int:
        *lines, self.begun = f"{self.begun}{text}".split("\n")
        self.found.update(((line.strip(), self.where()), None) for line in lines if line.strip())
        if len(self.found) > _MOST_REMARKS:
            raise ExcessError(f"the file prints more than {_MOST_REMARKS:,} things")
        return len(text)


def run(compiler: Compiler, confine: Callable[[], object] = confine) -> dict[str, Any]:
    """Do the task that the compiler gives, and send the result."""
    task = compiler.receive()
    try:
        expander = Expander(compiler, task["file"], yaml=task.get("yaml", True))
    except ImportError as error:
        return {"missing": str(error)}
    remarks = _Remarks(expander.place)
    sys.stdout = sys.stderr = remarks
    # From `confine` on nothing can be opened, so whatever is imported late has to be imported now.
    arguments = _Arguments(task["arguments"])
    for name in _NEEDED_LATER:
        import_module(name)
    confine()
    outcome = _expanded(expander, arguments)
    if expander.lacks_yaml:
        return {"lacks": "yaml"}
    noted = [[text, *place] for text, place in remarks.found]
    return {**outcome, "remarks": noted, "unused": sorted(arguments.unused)}


def _expanded(expander: Expander, arguments: dict[str, str]) -> dict[str, Any]:
    try:
        document = expander.expand(arguments)
        root = document.documentElement
        places = [] if root is None else list(places_below(root))
        text = document.toprettyxml(indent="  ")
        text.encode()  # half of a surrogate pair is no text
    except BadFileError as error:
        return {"error": str(error), "place": error.place}
    except Exception as error:  # noqa: BLE001 - an expression may raise anything, and it is the file's fault
        return {**description(error), "place": expander.place()}
    return {"text": text, "places": places}


def main() -> None:
    """Do one task."""
    end_with_parent()
    limit()
    channel = WorkerChannel()
    channel.send(run(channel))
