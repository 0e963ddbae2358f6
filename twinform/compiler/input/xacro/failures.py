"""Says in words what has ended an expansion, with what the file could have meant."""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from twinform.compiler.input.xacro.channel import AbsentError, MissingFileError, NotFoundError, TimeUpError
from twinform.compiler.input.xacro.definitions import Definitions
from twinform.compiler.input.xacro.places import FileLine

_LONGEST = 1000
"""Characters of a message, which repeats the expressions that it is about."""
_EXPRESSION = re.compile(
    r"\s*when evaluating expression '(?P<innermost>.*?)'(?=\s+when evaluating expression '|$)", re.DOTALL
)
_EVAL = re.compile(r"\s*when evaluating '(?P<eval>\$\(eval .*\))'", re.DOTALL)
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
    found = _EVAL.search(message)
    if found:
        return {"error": f"argument {name!r} is not defined{definitions.around()}, in {_shortened(found['eval'])}"}
    _, inside = _expression(message)
    words = f"property {name!r} is not defined{definitions.around()}{inside}"
    return {"error": words, "unknown": _unknown("property", name, definitions.properties)}


def _expression(message: str) -> tuple[str, str]:
    """Split the expression that it is about off a message of xacro."""
    found = _EXPRESSION.search(message)
    return (message[: found.start()], f", in ${{{_shortened(found['innermost'])}}}") if found else (message, "")


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
