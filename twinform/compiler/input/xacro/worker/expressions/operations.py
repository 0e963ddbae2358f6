"""The operators of expressions, as Python has them, on values of bounded size."""

import ast
import operator
from collections.abc import Callable, Mapping

from twinform.compiler.input.xacro.worker.expressions.budget import Budget, require_bits, require_items, require_length
from twinform.compiler.input.xacro.worker.expressions.expression_values import (
    ITERATOR,
    SCALARS,
    SEQUENCES,
    TYPES,
    ExpressionRefusedError,
    Value,
    weigh,
)
from twinform.compiler.input.xacro.worker.expressions.iterating import items


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
