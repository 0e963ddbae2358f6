"""The names that xacro gives to every expression, and the functions of Python and of `math` among them.

The names are taken from xacro itself, so that a name means something here whenever it does there. A function that is
not offered is still a name, and refused when it is called. Of Python, that is what leads from a value to its class or
shows where it lies in memory (`type`, `vars`, `hash`, ...); of `math`, what makes integers of any size.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from twinform.compiler.input.xacro.budget import Budget, require_items
from twinform.compiler.input.xacro.expression_values import (
    MAPPINGS,
    SCALARS,
    ExpressionRefusedError,
    Function,
    Namespace,
    Value,
    each,
    hashable,
    items,
    kind_of,
    text_of,
)
from twinform.compiler.input.xacro.operations import add, paying

# Decimal places before or behind the point; there are no floating point numbers beyond.
_MOST_ROUNDED = 400
# Functions whose result never has more than a few hundred digits, whatever they are given.
MATH = (
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "copysign", "cos", "cosh", "degrees",
    "dist", "erf", "erfc", "exp", "exp2", "expm1", "fabs", "floor", "fmod", "frexp", "fsum", "gamma", "gcd", "hypot",
    "isclose", "isfinite", "isinf", "isnan", "isqrt", "ldexp", "lgamma", "log", "log10", "log1p", "log2", "modf",
    "nextafter", "pow", "radians", "remainder", "sin", "sinh", "sqrt", "tan", "tanh", "trunc", "ulp",
)  # fmt: skip
_DEPRECATED = {"sorted": "python", "range": "python", "load_yaml": "xacro", "abs_filename": "xacro", "dotify": "xacro"}
"""Names that xacro still has outside of their namespaces."""


def math_functions(budget: Budget) -> dict[str, Function]:
    """The functions of `math`, as far as this Python has them."""
    return {name: Function(name, paying(getattr(math, name), budget)) for name in MATH if hasattr(math, name)}


def python_functions(budget: Budget) -> dict[str, Function]:
    """The functions of Python, which keep to a budget."""
    plain = {name: Function(name, paying(call, budget), kind) for name, (call, kind) in _PLAIN.items()}
    careful = {name: Function(name, partial(call, budget), kind) for name, (call, kind) in _CAREFUL.items()}
    return plain | careful


def refused(name: str) -> Function:
    """What stands for a function of xacro that is not offered."""

    def call(*_: Value, **__: Value) -> Value:
        raise ExpressionRefusedError(f"an expression must not use {name!r}")

    return Function(name, call)


def _text(budget: Budget, value: Value = "") -> str:
    return text_of(value, budget)


def _list(budget: Budget, values: Value = ()) -> list[Value]:
    return list(each(values, budget))


def _tuple(budget: Budget, values: Value = ()) -> tuple[Value, ...]:
    return tuple(each(values, budget))


def _set(budget: Budget, values: Value = ()) -> set[Value]:
    return set(items(values, budget))


def _dict(budget: Budget, values: Value = (), /, **named: Value) -> dict[Value, Value]:
    given: Value = values.items() if kind_of(values) in MAPPINGS else values
    pairs = [list(each(pair, budget)) for pair in each(given, budget)]
    return dict([(hashable(key, budget), value) for key, value in pairs], **named)


def _map(budget: Budget, function: Value, *several: Value) -> Value:
    call = _function(function)
    columns = [list(each(values, budget)) for values in several]
    return iter([call(*args) for args in zip(*columns, strict=False)])


def _zip(budget: Budget, *several: Value) -> Value:
    return iter(list(zip(*(list(each(values, budget)) for values in several), strict=False)))


def _enumerate(budget: Budget, values: Value, start: int = 0) -> Value:
    return iter(list(enumerate(each(values, budget), start)))


def _reversed(budget: Budget, values: Value) -> Value:
    len(values)  # an iterator cannot be reversed
    return iter(list(each(values, budget))[::-1])


def _sorted(budget: Budget, values: Value, *, key: Value = None, reverse: bool = False) -> list[Value]:
    return sorted(items(values, budget), key=_key(key), reverse=reverse)


def _extreme(python: Callable[..., Value]) -> Callable[..., Value]:
    def call(budget: Budget, *args: Value, key: Value = None, **default: Value) -> Value:
        found = items(args[0] if len(args) == 1 else args, budget)
        return python(found, key=_key(key), **default)

    return call


def _sum(budget: Budget, values: Value, start: Value = 0) -> Value:
    if isinstance(start, str):
        raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
    total = start
    for value in each(values, budget):
        total = add(total, value, budget)
    return total


def _range(_: Budget, *args: int) -> range:
    found = range(*args)
    # `len` of a range overflows beyond `sys.maxsize`.
    step = found.step
    require_items((found.stop - found.start + step - (1 if step > 0 else -1)) // step)
    return found


def _round(_: Budget, number: Value, ndigits: int | None = None) -> Value:
    if ndigits is not None and abs(ndigits) > _MOST_ROUNDED:
        raise ExpressionRefusedError(f"'round' must not be asked for {ndigits} digits")
    return round(number, ndigits)


def _isinstance(budget: Budget, value: Value, wanted: Value) -> bool:
    kinds = list(each(wanted, budget)) if isinstance(wanted, tuple) else [wanted]
    types = [kind.kind for kind in kinds if isinstance(kind, Function) and kind.kind]
    if len(types) != len(kinds):
        raise TypeError("isinstance() arg 2 must be a type or a tuple of types")
    return isinstance(value, tuple(types))


def _function(value: Value) -> Callable[..., Value]:
    if not isinstance(value, Function):
        raise TypeError(f"{type(value).__name__!r} object is not callable")
    return value.call


def _key(value: Value) -> Callable[..., Value] | None:
    return None if value is None else _function(value)


_PLAIN: Mapping[str, tuple[Callable[..., Any], type | None]] = {
    "abs": (abs, None),
    "all": (all, None),
    "any": (any, None),
    "bool": (bool, bool),
    "divmod": (divmod, None),
    "float": (float, float),
    "int": (int, int),
    "len": (len, None),
    "ord": (ord, None),
}
_CAREFUL: Mapping[str, tuple[Callable[..., Value], type | None]] = {
    "dict": (_dict, dict),
    "enumerate": (_enumerate, None),
    "isinstance": (_isinstance, None),
    "list": (_list, list),
    "map": (_map, None),
    "max": (_extreme(max), None),
    "min": (_extreme(min), None),
    "range": (_range, None),
    "reversed": (_reversed, None),
    "round": (_round, None),
    "set": (_set, set),
    "sorted": (_sorted, None),
    "str": (_text, str),
    "sum": (_sum, None),
    "tuple": (_tuple, tuple),
    "zip": (_zip, None),
}


PYTHON = (*_PLAIN, *_CAREFUL)
BARE = ("bool", "dict", "float", "int", "len", "list", "map", "max", "min", "round", "str")
"""What needs no `python.` before it."""
CONSTANTS = ("pi", "e", "tau", "inf", "nan", "True", "False", "None")


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
