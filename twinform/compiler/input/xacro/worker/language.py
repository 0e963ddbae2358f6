"""The functions of the namespace `xacro`, which expressions call."""

import re
from collections.abc import Callable
from typing import Protocol

from twinform.compiler.input.xacro.worker.expressions.budget import Budget
from twinform.compiler.input.xacro.worker.expressions.expression_values import (
    DotDict,
    ExpressionRefusedError,
    Value,
    text_of,
)


class Environment(Protocol):
    """What the functions need of the file that is expanded."""

    budget: Budget

    def argument(self, name: str) -> str:
        """An argument of the file."""
        ...

    def path(self, name: str) -> str:
        """What a file name means in the file that is being read."""
        ...

    def data(self, name: str) -> Value:
        """The content of a data file."""
        ...

    def say(self, text: str) -> None:
        """Have something reported."""
        ...

    def locate(self) -> None:
        """Have it reported which macros and files are being expanded."""
        ...

    def failure(self, message: str) -> Exception:
        """What stops the expansion."""
        ...


def xacro_functions(environment: Environment) -> dict[str, Callable[..., Value]]:
    """Every function that xacro documents; what they are given has been weighed."""

    def joined(args: tuple[Value, ...]) -> str:
        return environment.budget.write(" ".join(text_of(each, environment.budget) for each in args))

    def reporting(start: str) -> Callable[..., str]:
        def say(*args: Value, alt_text: str | None = None, **_: Value) -> str:
            environment.say(f"{start if alt_text is None else alt_text}{joined(args)}")
            return ""

        return say

    def fatal(*args: Value) -> Value:
        raise environment.failure(joined(args))

    def locate() -> str:
        environment.locate()
        return ""

    return {
        "abs_filename": environment.path,
        "arg": environment.argument,
        "dotify": DotDict,
        "error": reporting("error: "),
        "fatal": fatal,
        "load_yaml": environment.data,
        "message": reporting(""),
        "print_location": locate,
        "tokenize": _tokenize,
        "warning": reporting("warning: "),
    }


def _tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    if "]" in sep:
        raise ExpressionRefusedError("the separators of 'tokenize' must not have ']' among them")
    found = re.split(f"[{sep}]", text)
    return [each for each in found if each] if skip_empty else found
