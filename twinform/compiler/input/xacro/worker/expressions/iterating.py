"""Iteration over values: each item costs a step, and only what surely ends can be iterated over."""

from collections.abc import Iterator

from twinform.compiler.input.xacro.worker.expressions.budget import Budget, require_items
from twinform.compiler.input.xacro.worker.expressions.expression_values import SCALARS, TYPES, Value, weigh


def each(value: Value, budget: Budget) -> Iterator[Value]:
    """The items of a value, one by one, as a comprehension wants them.

    Raises:
        ExcessError: there are too many.
        RefusedError: this is no value.
    """
    if type(value) not in TYPES:
        weigh(value, budget)
    for count, item in enumerate(value, 1):
        budget.pay(item)
        require_items(count)
        yield item


def items(value: Value, budget: Budget) -> list[Value]:
    """The items of a value, none of which is so large that it cannot be compared or written."""
    found = list(each(value, budget))
    if any(type(item) not in SCALARS for item in found):
        weigh(found, budget)
    return found


def hashable(value: Value, budget: Budget) -> Value:
    """The value, if its hash can be had: that of a tuple goes through all that is in it."""
    if type(value) not in SCALARS:
        weigh(value, budget)
    return value
