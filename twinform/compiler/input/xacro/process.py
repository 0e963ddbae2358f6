"""The task of the process: expand one file within limits of memory and time, and send the result or what is wrong."""

import io
import signal
import sys
from collections.abc import Callable
from importlib import import_module
from itertools import islice
from types import FrameType
from typing import Any

from twinform.compiler.input.xacro.budget import ExcessError
from twinform.compiler.input.xacro.channel import Compiler, TimeUpError, WorkerChannel
from twinform.compiler.input.xacro.expander import Expander
from twinform.compiler.input.xacro.failures import description
from twinform.compiler.input.xacro.places import BadFileError, FileLine, included_texts, places_below
from twinform.confinement import confine, end_with_parent
from twinform.confinement.resources import limits, set_limit

MEMORY = 2**29
# Of 386 xacro files in the corpus one, a pendulum of 1,201 links, takes 9.3 s and is right; all
# others take less than 0.4 s.
SECONDS = 10
"""Of processor time. The slowest real file that we know takes from one to nine, as machines are."""
# Seconds of processor time to report where the time went.
_GRACE = 2
# Frames of Python. xacro takes about ten for each macro inside a macro.
_DEEPEST = 4000
_MOST_REMARKS = 1000
# Python imports these when it meets certain characters, and could not do so once the process is
# confined.
_NEEDED_LATER = ("unicodedata", "encodings.cp1252", "encodings.iso8859_15", "encodings.utf_16")


def limit() -> None:
    """Keep whatever takes long or grows from taking the machine with it."""
    sys.setrecursionlimit(_DEEPEST)
    if limits() is None:
        return
    set_limit("AS", MEMORY)
    set_limit("FSIZE", 0)
    # As an exception, the signal is reported with the element that was being expanded. The hard
    # limit, which kills without a word, comes two seconds later.
    signal.signal(signal.SIGXCPU, _time_is_up)
    set_limit("CPU", SECONDS, _GRACE)


def _time_is_up(signum: int, frame: FrameType | None) -> None:
    del signum, frame
    raise TimeUpError(f"the expansion takes more than {SECONDS} seconds of the processor")


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
    absent = [[name, *place] for name, place in expander.absent.items()]
    return {**outcome, "remarks": noted, "unused": sorted(arguments.unused), "absent": absent}


def _expanded(expander: Expander, arguments: dict[str, str]) -> dict[str, Any]:
    try:
        document = expander.expand(arguments)
        root = document.documentElement
        places = [] if root is None else list(places_below(root))
        strays = [] if root is None else list(islice(included_texts(root), _MOST_REMARKS))
        text = document.toprettyxml(indent="  ")
        text.encode()  # half of a surrogate pair is no text
    except BadFileError as error:
        return {"error": str(error), "place": error.place, "syntax": error.is_syntax}
    except Exception as error:  # noqa: BLE001 - an expression may raise anything, and it is the file's fault
        return {**description(error, expander.definitions), "place": expander.place()}
    return {"text": text, "places": places, "strays": strays}


def main() -> None:
    """Do one task."""
    end_with_parent()
    limit()
    channel = WorkerChannel()
    channel.send(run(channel))
