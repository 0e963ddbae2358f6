"""Error messages of a failed expansion."""

from typing import Any

from twinform.compiler.input.xacro.worker.channel import MissingFileError, NotFoundError

_LONGEST = 1000
"""Characters of a message, which repeats the expressions that it is about."""


class TimeUpError(Exception):
    """The process has used up its time."""


def description(error: BaseException) -> dict[str, str]:
    """The message of an exception, and the macros through which it came."""
    cause = _cause(error)
    match cause:
        case RecursionError():
            return {"error": "macros or expressions go round without an end"}
        case MemoryError():
            return {"error": "an expression needs more memory than there is for it"}
        case NotFoundError():
            return {"error": _shortened(cause), "help": cause.advice}
        case MissingFileError() | TimeUpError():
            return {"error": _shortened(cause)}
        case _:
            return {"error": _with_macros(error)}


def _shortened(error: BaseException) -> str:
    text = " ".join(str(error).split()) or type(error).__name__
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."


def _with_macros(error: BaseException) -> str:
    text = _shortened(error)
    macros: list[Any] = getattr(error, "macros", [])
    names = [macro.body.getAttribute("name") for macro in macros if macro.body is not None]
    return f"{text} (in macro {', '.join(names)})" if names else text


def _cause(error: BaseException) -> BaseException:
    """The exception inside those that xacro wraps it in."""
    while isinstance(inner := getattr(error, "exc", None), BaseException):
        error = inner
    return error
