"""Attribute access in expressions: members of namespaces, items of dictionaries of data files, and methods."""

from collections.abc import Callable

from twinform.compiler.input.xacro.worker.expressions.budget import Budget
from twinform.compiler.input.xacro.worker.expressions.expression_values import (
    DotDict,
    ExpressionRefusedError,
    Function,
    Namespace,
    Value,
    kind_of,
)
from twinform.compiler.input.xacro.worker.expressions.methods import METHODS

_NAMES_OF_DICT = frozenset(dir(dict))


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
    method = methods[name]
    return lambda *args, **named: method(value, budget, *args, **named)


def _named(members: Value, name: str) -> Value:
    try:
        return members[name]
    except KeyError as error:
        raise NameError(f"name {name!r} is not defined") from error


def _kind(value: Value) -> str:
    return f"a value of the type {kind_of(value).__name__!r}"
