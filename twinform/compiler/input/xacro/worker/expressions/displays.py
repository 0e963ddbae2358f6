"""Lists, tuples, sets and dictionaries as they are written in expressions, and comprehensions."""

import ast
from collections.abc import Iterator
from typing import Protocol

from twinform.compiler.input.xacro.worker.expressions.budget import Budget
from twinform.compiler.input.xacro.worker.expressions.expression_values import ExpressionRefusedError, NameLookup, Value
from twinform.compiler.input.xacro.worker.expressions.iterating import each, hashable


class Evaluator(Protocol):
    """What evaluates the parts."""

    budget: Budget

    def value(self, node: ast.expr, names: NameLookup) -> Value:
        """The value of a part."""
        ...


class _Scope:
    """The names of a comprehension, and those around it."""

    def __init__(self, around: NameLookup) -> None:
        self.around = around
        self.own: dict[str, Value] = {}

    def __getitem__(self, name: str) -> Value:
        return self.own[name] if name in self.own else self.around[name]


def list_display(evaluator: Evaluator, node: ast.List, names: NameLookup) -> list[Value]:
    """`[a, b]`."""
    return [evaluator.value(part, names) for part in node.elts]


def tuple_display(evaluator: Evaluator, node: ast.Tuple, names: NameLookup) -> tuple[Value, ...]:
    """`(a, b)`."""
    return tuple(evaluator.value(part, names) for part in node.elts)


def set_display(evaluator: Evaluator, node: ast.Set, names: NameLookup) -> set[Value]:
    """`{a, b}`."""
    return {_key(evaluator, part, names) for part in node.elts}


def dict_display(evaluator: Evaluator, node: ast.Dict, names: NameLookup) -> dict[Value, Value]:
    """`{a: b}`."""
    pairs = [(key, value) for key, value in zip(node.keys, node.values, strict=True) if key]
    return {_key(evaluator, key, names): evaluator.value(value, names) for key, value in pairs}


def list_comprehension(evaluator: Evaluator, node: ast.ListComp, names: NameLookup) -> list[Value]:
    """`[a for b in c]`."""
    return [evaluator.value(node.elt, scope) for scope in _scopes(evaluator, node.generators, names)]


def generator(evaluator: Evaluator, node: ast.GeneratorExp, names: NameLookup) -> Iterator[Value]:
    """`(a for b in c)`, all of it at once: an iterator without a frame behind it."""
    # A real generator has a frame (`gi_frame`), and with it the globals of this module: the way out
    # of simpleeval.
    return iter([evaluator.value(node.elt, scope) for scope in _scopes(evaluator, node.generators, names)])


def set_comprehension(evaluator: Evaluator, node: ast.SetComp, names: NameLookup) -> set[Value]:
    """`{a for b in c}`."""
    return {_key(evaluator, node.elt, scope) for scope in _scopes(evaluator, node.generators, names)}


def dict_comprehension(evaluator: Evaluator, node: ast.DictComp, names: NameLookup) -> dict[Value, Value]:
    """`{a: b for c in d}`."""
    scopes = _scopes(evaluator, node.generators, names)
    return {_key(evaluator, node.key, scope): evaluator.value(node.value, scope) for scope in scopes}


def _key(evaluator: Evaluator, node: ast.expr, names: NameLookup) -> Value:
    return hashable(evaluator.value(node, names), evaluator.budget)


def _scopes(evaluator: Evaluator, generators: list[ast.comprehension], names: NameLookup) -> Iterator[NameLookup]:
    """The names as they are each time that the inside of a comprehension is evaluated."""
    if not generators:
        yield names
        return
    first, *rest = generators
    scope = _Scope(names)
    for item in each(evaluator.value(first.iter, names), evaluator.budget):
        _assign(first.target, item, scope, evaluator.budget)
        if all(evaluator.value(condition, scope) for condition in first.ifs):
            yield from _scopes(evaluator, rest, scope)


def _assign(target: ast.expr, value: Value, scope: _Scope, budget: Budget) -> None:
    match target:
        case ast.Name(id=name):
            scope.own[name] = value
        case ast.Tuple(elts=parts) | ast.List(elts=parts):
            for part, item in zip(parts, list(each(value, budget)), strict=True):
                _assign(part, item, scope, budget)
        case _:
            raise ExpressionRefusedError("a comprehension must assign to names")
