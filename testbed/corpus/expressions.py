"""Every expression of real xacro files, evaluated by xacro and by us, with invented values for its names."""

import ast
import contextlib
import html
import io
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

from testbed.corpus.files import CORPUS, CorpusFile
from testbed.corpus.plain_xacro import users_of_xacro
from twinform.compiler.input.xacro.budget import Budget
from twinform.compiler.input.xacro.expression_values import DotDict
from twinform.compiler.input.xacro.interpreter import Interpreter
from twinform.compiler.input.xacro.vocabulary import vocabulary

_XACRO: Any = import_module("xacro")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_EXPRESSION = re.compile(r"\$\{([^}]*)\}")
_SUBSTITUTION = re.compile(r"\$\([^)]*\)")
_LIKE: tuple[Callable[[], Any], ...] = (
    lambda: 0.5,
    lambda: 2,
    lambda: "0.1 0.2 0.3",
    lambda: "left",
    lambda: True,
    lambda: [1.0, 2.5, 3],
    lambda: _XACRO.YamlDictWrapper(a=1, b=[1, 2]),
    lambda: None,
)
"""What the names of an expression stand for, one after the other."""
_ADDRESS = re.compile(r" at 0x[0-9a-f]+>|^<function \w+>$")
_OF_FILES = re.compile(r"\bxacro\.|\bload_yaml\b")


@dataclass(frozen=True, slots=True)
class Result:
    """What an expression is: a value, or a mistake."""

    value: str = ""
    mistake: str = ""

    @property
    def is_mistake(self) -> bool:
        """Whether there is no value."""
        return bool(self.mistake)


@dataclass(frozen=True, slots=True)
class Evaluated:
    """An expression, what xacro makes of it, and what we do."""

    expression: str
    theirs: Result
    ours: Result

    @property
    def is_alike(self) -> bool:
        """Whether both have the same value, or none."""
        return self.theirs.is_mistake == self.ours.is_mistake and self.theirs.value == self.ours.value


@cache
def expressions() -> tuple[str, ...]:
    """Every expression of the corpus once; a substitution in it is 1, since its value is not there.

    Those that call functions of xacro for files are left out: they are compared with the files.
    """
    found = {each for file in users_of_xacro() for each in _expressions_of(file)}
    return tuple(sorted(each for each in found if not _OF_FILES.search(each)))


def _expressions_of(file: CorpusFile) -> Iterator[str]:
    text = _COMMENT.sub("", (CORPUS / file.name).read_text(encoding="utf-8", errors="replace"))
    for inside in _EXPRESSION.findall(text):
        yield html.unescape(_SUBSTITUTION.sub("1", inside))


def evaluated(expression: str) -> Iterator[Evaluated]:
    """What both make of an expression, for each kind of value that its names may have."""
    names = _free_names(expression)
    for like in _LIKE if names else _LIKE[:1]:
        theirs = _result(_theirs, expression, {name: like() for name in names})
        yield Evaluated(expression, theirs, _result(_ours, expression, {name: _ours_like(like()) for name in names}))


def _free_names(expression: str) -> list[str]:
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except SyntaxError:
        return []
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return sorted(names - set(_symbols()))


def _symbols() -> Mapping[str, Any]:
    return _XACRO._global_symbols  # noqa: SLF001 - xacro gives them to nobody


def _theirs(expression: str, values: dict[str, Any]) -> Any:
    return _XACRO.safe_eval(expression, {**_symbols(), **values})


def _ours(expression: str, values: dict[str, Any]) -> Any:
    budget = Budget()
    known = vocabulary(_symbols(), dict.fromkeys(_symbols()["xacro"], _unknown), budget, _unknown)
    return Interpreter(budget).evaluate(expression, {**known, **values})


def _ours_like(value: Any) -> Any:
    return DotDict(value) if isinstance(value, _XACRO.YamlDictWrapper) else value


def _unknown(*_: object, **__: object) -> None:
    """What the functions of xacro itself give: they are for files, not for expressions alone."""


def _result(evaluate: Callable[..., Any], expression: str, values: dict[str, Any]) -> Result:
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            value = evaluate(expression, values)
    except Exception as error:  # noqa: BLE001 - an expression may raise anything
        return Result(mistake=f"{type(error).__name__}: {error}")
    text = str(value)
    # functions, methods and iterators are no values that a robot could be made of
    return Result(mistake=text) if _ADDRESS.search(text) else Result(text)
