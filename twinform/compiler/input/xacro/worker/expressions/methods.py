"""The methods of texts, lists and dictionaries that are offered, by the exact type of the value before the dot."""

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from twinform.compiler.input.xacro.worker.expressions.budget import Budget, ExcessError, require_items, require_length
from twinform.compiler.input.xacro.worker.expressions.expression_values import (
    SCALARS,
    DotDict,
    DotList,
    ExpressionRefusedError,
    Value,
    text_of,
    weigh,
)
from twinform.compiler.input.xacro.worker.expressions.iterating import hashable, items

Method = Callable[..., Value]
"""Takes the value before the dot, the budget, and the arguments."""
# Characters that `strip` looks for: it compares each of them with each of the text.
_LONGEST_SET = 1000
_FIELD = re.compile(r"\{\{|\}\}|\{(\w*)\}|[{}]")


def _plain(kind: type[Any], *names: str) -> dict[str, Method]:
    """Methods that make nothing larger of what they are given, and take as long as that is large."""
    return {name: _weighing(getattr(kind, name)) for name in names}


def _weighing(python: Callable[..., Value]) -> Method:

    def call(value: Value, budget: Budget, *args: Value, **named: Value) -> Value:
        for each in (value, *args, *named.values()):
            if type(each) not in SCALARS:
                weigh(each, budget)
        result = python(value, *args, **named)
        budget.pay(result)
        return result

    return call


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


def _format(text: str, budget: Budget, *args: Value, **named: Value) -> str:
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
    **_plain(
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
_LIST: Mapping[str, Method] = {**_plain(list, "count", "index", "pop"), "append": _append, "extend": _extend}
_DICT: Mapping[str, Method] = {**_plain(dict, "items", "keys", "values"), "get": _get, "pop": _pop}
METHODS: Mapping[type[Any], Mapping[str, Method]] = {
    str: _TEXT,
    list: _LIST,
    DotList: _LIST,
    dict: _DICT,
    DotDict: _DICT,
}
