"""The task of the process: expand one file within limits of memory and time, and send the result or what is wrong."""

import io
import os
import re
import signal
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from itertools import islice
from types import FrameType
from typing import Any

from twinform.compiler.input.xacro.budget import ExcessError
from twinform.compiler.input.xacro.channel import (
    AbsentError,
    Compiler,
    MissingFileError,
    NotFoundError,
    TimeUpError,
    WorkerChannel,
)
from twinform.compiler.input.xacro.expander import Expander
from twinform.compiler.input.xacro.places import BadFileError, Definitions, FileLine, included_texts, places_below
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
        # what stands in an element of another file came with an include
        texts = () if root is None or len(expander.parsed) == 1 else included_texts(root)
        strays = list(islice(texts, _MOST_REMARKS))
        text = document.toprettyxml(indent="  ")
        text.encode()  # half of a surrogate pair is no text
    except BadFileError as error:
        return {"error": str(error), "place": error.place, "syntax": error.is_syntax}
    except Exception as error:  # noqa: BLE001 - an expression may raise anything, and it is the file's fault
        return {**description(error, expander.definitions), "place": expander.place()}
    return {"text": text, "places": places, "calls": expander.definitions.made, "strays": strays}


def main() -> None:
    """Do one task, and leave the process: to free all that it has made takes as long as to make half of it."""
    end_with_parent()
    limit()
    channel = WorkerChannel()
    channel.send(run(channel))
    os._exit(0)


_LONGEST = 1000
"""Characters of a message, which repeats the expressions that it is about."""
_EXPRESSION, _EVAL = "when evaluating expression '", "when evaluating '$(eval "
"""What the messages of xacro say before an expression; the innermost expression comes first."""
Description = dict[str, Any]
"""What the compiler is told: the message, and its help or an unknown name with the known ones and their places."""


def description(error: BaseException, definitions: Definitions) -> Description:
    """Describe what has ended an expansion."""
    cause = _cause(error)
    match cause:
        case RecursionError():
            return {"error": definitions.circle() or "macros or expressions go round without an end"}
        case MemoryError():
            return {"error": "an expression needs more memory than there is for it"}
        case AbsentError():
            return {"error": "", "rule": "missing-package"}
        case NotFoundError():
            return {"error": _shortened(str(cause)), "help": cause.advice}
        case MissingFileError() | TimeUpError():
            return {"error": _shortened(str(cause))}
        case Exception() if type(cause).__name__ == "ArgException":
            return {"error": "", "rule": "missing-argument", "argument": _shortened(str(cause))}
        case NameError(name=str(name)):
            return _unknown_property(name, str(error), definitions)
        case _:
            return _of_xacro(error, definitions)


def _cause(error: BaseException) -> BaseException:
    """The exception inside those that xacro wraps it in."""
    while isinstance(inner := getattr(error, "exc", None), BaseException):
        error = inner
    return error


def _shortened(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."


def _unknown_property(name: str, message: str, definitions: Definitions) -> Description:
    _, said, rest = message.partition(_EVAL)
    if said:
        evaluated = f"$(eval {rest[: rest.rfind(')')]})"
        return {"error": f"argument {name!r} is not defined{definitions.around()}, in {_shortened(evaluated)}"}
    _, inside = _expression(message)
    words = f"property {name!r} is not defined{definitions.around()}{inside}"
    return {"error": words, "unknown": _unknown("property", name, definitions.properties)}


def _expression(message: str) -> tuple[str, str]:
    """Split the expression that it is about off a message of xacro."""
    before, said, rest = message.partition(_EXPRESSION)
    innermost = rest.partition(_EXPRESSION)[0].rstrip()
    if not said or not innermost.endswith("'"):
        return message, ""
    return before.rstrip(), f", in ${{{_shortened(innermost[:-1])}}}"


def _unknown(kind: str, name: str, known: Mapping[str, FileLine | None]) -> Description:
    return {"kind": kind, "name": name, "known": dict(known)}


def _of_xacro(error: BaseException, definitions: Definitions) -> Description:
    """Describe an exception of xacro, whose messages are those of a program and not of a robot."""
    message, inside = _expression(str(error))
    text = _shortened(message) or type(error).__name__
    macro = next(iter(getattr(error, "macros", ())), None)
    for pattern, describe in _MESSAGES.items():
        found = re.search(pattern, text)
        if found:
            return describe(found, macro, definitions)
    return {"error": f"{text}{definitions.around()}{inside}"}


def _no_macro(found: re.Match[str], _: Any, definitions: Definitions) -> Description:
    unknown = _unknown("macro", found["name"], definitions.macros)
    return {"error": f"there is no macro {found['name']!r}{definitions.around()}", "unknown": unknown}


def _no_parameter(found: re.Match[str], macro: Any, _: Definitions) -> Description:
    known = {name.lstrip("*"): None for name in macro.params}
    unknown = _unknown("parameter", found["name"], known)
    return {"error": f"macro {_name(macro)!r} has no parameter {found['name']!r}", "unknown": unknown}


def _lacking_parameters(found: re.Match[str], macro: Any, _: Definitions) -> Description:
    names = [repr(name) for name in found["names"].split(",")]
    word = "parameter" if len(names) == 1 else "parameters"
    return {"error": f"macro {_name(macro)!r} is called without its {word} {_listed(names)}"}


def _few_blocks(_: re.Match[str], macro: Any, __: Definitions) -> Description:
    names = _listed([repr(name.lstrip("*")) for name in macro.params if name.startswith("*")])
    return {"error": f"macro {_name(macro)!r} is called with fewer elements inside than it has blocks: {names}"}


def _many_blocks(found: re.Match[str], macro: Any, _: Definitions) -> Description:
    return {"error": f"macro {_name(macro)!r} is called with <{found['name']}> inside, for which it has no block"}


def _circular(found: re.Match[str], _: Any, definitions: Definitions) -> Description:
    way = found["way"].split(" -> ")
    words = f"property {way[0]!r} is defined by itself: {' -> '.join(way)}{definitions.around()}"
    return {"error": words, "help": 'lazy_eval="false" takes the value that a property has before'}


def _no_block(found: re.Match[str], _: Any, definitions: Definitions) -> Description:
    return {"error": f"there is no block {found['name']!r}{definitions.around()}"}


def _name(macro: Any) -> str:
    return macro.body.getAttribute("name").removeprefix("xacro:")


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


_MESSAGES: Mapping[str, Callable[[re.Match[str], Any, Definitions], Description]] = {
    r"^unknown macro name: (?:xacro:)?(?P<name>\S+)$": _no_macro,
    r'^Invalid parameter "(?P<name>[^"]*)"': _no_parameter,
    r"^Undefined parameters \[(?P<names>[^\]]*)\]": _lacking_parameters,
    r"^Not enough blocks": _few_blocks,
    r"^circular variable definition: (?P<way>\S+(?: -> \S+)*)": _circular,
    r'^Unused block "(?P<name>[^"]*)"': _many_blocks,
    r'^Undefined block "(?P<name>[^"]*)"': _no_block,
}
