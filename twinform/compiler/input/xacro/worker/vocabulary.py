"""The names that xacro gives to every expression, each with what it stands for here.

They are taken from xacro itself, so that a name means something here whenever it does there: a function that is not
offered is still a name, and refused when it is called.
"""

from collections.abc import Callable, Mapping
from typing import Any

from twinform.compiler.input.xacro.worker.expressions.budget import Budget
from twinform.compiler.input.xacro.worker.expressions.expression_values import SCALARS, Function, Namespace, Value
from twinform.compiler.input.xacro.worker.expressions.functions import math_functions, paying, python_functions, refused

_DEPRECATED = {"sorted": "python", "range": "python", "load_yaml": "xacro", "abs_filename": "xacro", "dotify": "xacro"}
"""Names that xacro still has outside of their namespaces."""


def vocabulary(
    theirs: Mapping[str, Any], own: Mapping[str, Callable[..., Value]], budget: Budget, warn: Callable[[str], None]
) -> dict[str, Value]:
    """What each name of xacro's global symbols stands for; `own` are the functions of its namespace `xacro`."""
    python, math = python_functions(budget), math_functions(budget)
    xacro = {name: Function(name, paying(call, budget)) for name, call in own.items()}
    spaces = {"python": python, "math": math, "xacro": xacro}
    found: dict[str, Value] = {}
    for name, value in theirs.items():
        if name in spaces:
            members = {member: _offered(member, spaces[name], value.get(member)) for member in value}
            found[name] = Namespace(name, members)
        elif name in _DEPRECATED:
            found[name] = _deprecated(name, spaces[_DEPRECATED[name]][name], warn)
        else:
            found[name] = _offered(name, math | python, value)
    return found


def eval_vocabulary(
    theirs: Mapping[str, Any], own: Mapping[str, Callable[..., Value]], budget: Budget
) -> dict[str, Value]:
    """Return the names that `$(eval ...)` may use: xacro's `_eval_dict` and its builtins."""
    offered = python_functions(budget) | math_functions(budget)
    offered |= {name: Function(name, paying(call, budget)) for name, call in own.items()}
    flat = {**theirs, **theirs["__builtins__"], **own}
    return {name: _offered(name, offered, value) for name, value in flat.items() if not name.startswith("__")}


def _offered(name: str, functions: Mapping[str, Value], value: object) -> Value:
    """What is offered under a name: numbers as they are."""
    return value if type(value) in SCALARS else functions.get(name) or refused(name)


def _deprecated(name: str, function: Function, warn: Callable[[str], None]) -> Function:
    space = _DEPRECATED[name]
    message = f"Using {name}() directly is deprecated. Use {space}.{name}() instead."

    def call(*args: Value, **named: Value) -> Value:
        warn(message)
        return function.call(*args, **named)

    return Function(name, call, function.kind)
