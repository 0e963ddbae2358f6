"""What expressions may do with values: the operators of Python, methods, and members behind a dot.

Methods are offered by the exact type of the value before the dot.
"""

import ast
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from twinform.compiler.input.xacro.budget import Budget, ExcessError, require_bits, require_items, require_length
from twinform.compiler.input.xacro.expression_values import (
    ITERATOR,
    SCALARS,
    SEQUENCES,
    TYPES,
    DotDict,
    DotList,
    ExpressionRefusedError,
    Function,
    Namespace,
    Value,
    hashable,
    items,
    kind_of,
    text_of,
    weigh,
)
from twinform.lazy import lazy_pattern

Method = Callable[..., Value]
"""Takes the value before the dot, the budget, and the arguments."""
# Characters that `strip` looks for: it compares each of them with each of the text.
_LONGEST_SET = 1000
_FIELD = lazy_pattern(r"\{\{|\}\}|\{(\w*)\}|[{}]")
_NAMES_OF_DICT = frozenset(dir(dict))


def binary(node: ast.operator, left: Value, right: Value, budget: Budget) -> Value:
    """What an operator makes of two values.

    Raises:
        ExcessError: too much.
        RefusedError: what is not offered here.
    """
    for value in (left, right):
        if type(value) not in TYPES:
            weigh(value, budget)
    match node:
        case ast.Mult():
            _require_product(left, right)
        case ast.Pow():
            _require_power(left, right)
        # `'%0999999999d' % 1` fills the memory.
        case ast.Mod() if isinstance(left, str):
            raise ExpressionRefusedError("an expression must not use '%' on a text")
        case _:
            pass
    result = _BINARY[type(node)](left, right)
    if isinstance(result, complex):
        raise ExpressionRefusedError("an expression must not use complex numbers")
    budget.pay(result)
    return result


def add(left: Value, right: Value, budget: Budget) -> Value:
    """The sum of two values."""
    return binary(ast.Add(), left, right, budget)


def _require_product(left: Value, right: Value) -> None:
    for many, times in ((left, right), (right, left)):
        if isinstance(times, int) and isinstance(many, str):
            require_length(len(many) * times)
        elif isinstance(times, int) and type(many) in SEQUENCES:
            require_items(len(many) * times)


def _require_power(base: Value, exponent: Value) -> None:
    if isinstance(base, int) and isinstance(exponent, int):
        # one bit less than there are: 1 to the power of anything is 1
        require_bits((abs(base).bit_length() - 1) * exponent)
        require_bits(abs(exponent).bit_length())


_BINARY: Mapping[type[ast.operator], Callable[[Value, Value], Value]] = {
    ast.Add: lambda left, right: left + right,
    ast.Sub: lambda left, right: left - right,
    ast.Mult: lambda left, right: left * right,
    ast.Div: lambda left, right: left / right,
    ast.FloorDiv: lambda left, right: left // right,
    ast.Mod: lambda left, right: left % right,
    ast.Pow: lambda left, right: left**right,
}


def unary(node: ast.unaryop, value: Value) -> Value:
    """What an operator makes of one value."""
    return _UNARY[type(node)](value)


_UNARY: Mapping[type[ast.unaryop], Callable[[Value], Value]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}


def compare(node: ast.cmpop, left: Value, right: Value, budget: Budget) -> bool:
    """The result of a comparison of two values.

    Raises:
        ExcessError: they are too large to be compared.
    """
    for value in (left, right):
        if type(value) not in SCALARS:
            weigh(value, budget)
    if type(right) is ITERATOR:
        right = items(right, budget)
    return _COMPARE[type(node)](left, right)


_COMPARE: Mapping[type[ast.cmpop], Callable[[Value, Value], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda item, container: item in container,
    ast.NotIn: lambda item, container: item not in container,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
}


def paying(python: Callable[..., Any], budget: Budget) -> Callable[..., Value]:
    """A function that looks at no more than what it is given."""

    def call(*args: Value, **named: Value) -> Value:
        for value in (*args, *named.values()):
            if type(value) not in SCALARS:
                weigh(value, budget)
        result = python(*args, **named)
        budget.pay(result)
        return result

    return call


def _plain_methods(kind: type[Any], *names: str) -> dict[str, Method]:
    """Methods that make nothing larger of what they are given, and take as long as that is large."""
    return {name: partial(_pay, getattr(kind, name)) for name in names}


def _pay(python: Callable[..., Value], value: Value, budget: Budget, /, *args: Value, **named: Value) -> Value:
    return paying(python, budget)(value, *args, **named)


def _strip(python: Callable[..., str]) -> Method:
    def call(text: str, budget: Budget, characters: str | None = None) -> str:
        if characters and len(characters) > _LONGEST_SET:
            raise ExcessError(f"'strip' looks for more than {_LONGEST_SET:,} characters")
        result = python(text, characters)
        budget.pay(result)
        return result

    return call


def _replace(text: str, budget: Budget, old: str, new: str, count: int = -1) -> str:
    found = text.count(old)
    times = found if count < 0 else min(found, count)
    require_length(len(text) + times * (len(new) - len(old)))
    result = text.replace(old, new, count)
    budget.pay(result)
    return result


def _join(text: str, budget: Budget, parts: Value) -> str:
    found = items(parts, budget)
    require_length(sum(len(part) for part in found if isinstance(part, str)) + len(text) * len(found))
    result = text.join(found)
    budget.pay(result)
    return result


def _format(text: str, budget: Budget, /, *args: Value, **named: Value) -> str:
    """What `str.format` makes of fields that are a name, a number or nothing; others lead to attributes."""
    # `str.format` itself is never called: its fields reach attributes and items of any value.
    fields = [match[1] for match in _FIELD.finditer(text) if match[1] is not None]
    if "" in fields and any(map(str.isdecimal, fields)):
        raise ValueError("cannot switch between automatic and manual field numbering")
    unnamed = iter(range(len(fields)))
    length = len(text)

    def filled(match: re.Match[str]) -> str:
        nonlocal length
        found = text_of(_field(match, unnamed, args, named), budget)
        budget.spend()
        length += len(found)
        require_length(length)
        return found

    return _FIELD.sub(filled, text)


def _field(match: re.Match[str], unnamed: Iterator[int], args: tuple[Value, ...], named: Mapping[str, Value]) -> Value:
    name = match[1]
    # `'{0.__class__}'.format(x)` would lead from a value to its class.
    if name is None and len(match[0]) == 1:
        raise ExpressionRefusedError("the fields of 'format' must be names or numbers, as in '{name}'")
    if name is None:
        return match[0][0]
    if not name:
        return args[next(unnamed)]
    return args[int(name)] if name.isdecimal() else named[name]


def _zfill(text: str, budget: Budget, width: int) -> str:
    require_length(width)
    result = text.zfill(width)
    budget.pay(result)
    return result


def _append(values: list[Value], budget: Budget, item: Value) -> None:
    require_items(len(values) + 1)
    budget.spend()
    values.append(item)


def _extend(values: list[Value], budget: Budget, more: Value) -> None:
    found = items(more, budget)
    require_items(len(values) + len(found))
    values.extend(found)


def _get(values: dict[Value, Value], budget: Budget, key: Value, default: Value = None) -> Value:
    return values.get(hashable(key, budget), default)


def _pop(values: dict[Value, Value], budget: Budget, key: Value, *default: Value) -> Value:
    return values.pop(hashable(key, budget), *default)


_TEXT: Mapping[str, Method] = {
    **_plain_methods(
        str, "capitalize", "count", "endswith", "find", "isdigit", "lower", "split", "startswith", "title", "upper"
    ),
    "format": _format,
    "join": _join,
    "lstrip": _strip(str.lstrip),
    "replace": _replace,
    "rstrip": _strip(str.rstrip),
    "strip": _strip(str.strip),
    "zfill": _zfill,
}
_LIST: Mapping[str, Method] = {**_plain_methods(list, "count", "index", "pop"), "append": _append, "extend": _extend}
_DICT: Mapping[str, Method] = {**_plain_methods(dict, "items", "keys", "values"), "get": _get, "pop": _pop}
METHODS: Mapping[type[Any], Mapping[str, Method]] = {
    str: _TEXT,
    list: _LIST,
    DotList: _LIST,
    dict: _DICT,
    DotDict: _DICT,
}


def member(value: Value, name: str, scope: type | None) -> Value:
    """A member of a namespace, of an included file (whose names have the type `scope`), or of a dictionary.

    Raises:
        RefusedError: this has none.
    """
    if type(value) is Namespace:
        return _named(value.members, name)
    if scope and type(value) is scope:
        return _named(value, name)
    if type(value) is not DotDict:
        raise ExpressionRefusedError(f"an expression must not use {name!r} of {_kind(value)}")
    if name in _NAMES_OF_DICT:
        raise ExpressionRefusedError(f"an expression must not use {name!r} of a dictionary; [{name!r}] is its item")
    if name not in value:
        raise AttributeError(f"The yaml dictionary has no key {name!r}")
    return value[name]


def callable_member(value: Value, name: str, scope: type | None, budget: Budget) -> Callable[..., Value]:
    """A method of a value, or a function that is its member.

    Raises:
        RefusedError: it has none, or it is not offered.
    """
    methods = METHODS.get(kind_of(value))
    if methods is None:
        found = member(value, name, scope)
        if type(found) is not Function:
            raise TypeError(f"{type(found).__name__!r} object is not callable")
        return found.call
    if name not in methods:
        offered = ", ".join(sorted(methods))
        raise ExpressionRefusedError(f"an expression must not use {name!r} of {_kind(value)}, only {offered}")
    return partial(methods[name], value, budget)


def _named(members: Value, name: str) -> Value:
    try:
        return members[name]
    except KeyError as error:
        raise NameError(f"name {name!r} is not defined") from error


def _kind(value: Value) -> str:
    return f"a value of the type {kind_of(value).__name__!r}"
