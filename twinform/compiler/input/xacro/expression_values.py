"""The values of expressions: plain values of Python, functions that are offered, names behind a dot, and iteration."""

from collections.abc import Callable, Iterator, Mapping
from datetime import date, datetime, time
from typing import Any, Protocol, SupportsIndex, cast

from twinform.compiler.input.xacro.budget import (
    CHARACTERS_A_STEP,
    ITEMS_A_STEP,
    LONGEST_TEXT,
    Budget,
    ExcessError,
    require_items,
)

Value = Any
"""A value of an expression. What it may be is decided when it is used, by its exact type."""


class NameLookup(Protocol):
    """Where the names of an expression are looked up."""

    def __getitem__(self, name: str, /) -> Value:
        """What a name stands for.

        Raises:
            KeyError: nothing.
        """
        ...


class ExpressionRefusedError(Exception):
    """An expression wants what is not offered to it."""


class DotDict(dict[Any, Any]):
    """A dictionary of a data file: expressions reach its items behind a dot too. It is xacro's YamlDictWrapper."""

    def __getitem__(self, key: object) -> Value:
        return dotted(super().__getitem__(key))


class DotList(list[Any]):
    """A list of a data file, whose dictionaries are dotted too. It is xacro's YamlListWrapper."""

    def __getitem__(self, index: SupportsIndex | slice) -> Value:
        return dotted(super().__getitem__(index))

    def __iter__(self) -> Iterator[Value]:
        return map(dotted, super().__iter__())


def dotted(value: Value) -> Value:
    """The value, dotted where it is a dictionary or a list; a copy, as in xacro."""
    if isinstance(value, dict):
        return DotDict(cast("dict[Any, Any]", value))
    if isinstance(value, list):
        return DotList(cast("list[Any]", value))
    return value


class Function:
    """A function that expressions may call; `kind` is the type that it stands for as an argument of `isinstance`."""

    __slots__ = ("call", "kind", "name")

    def __init__(self, name: str, call: Callable[..., Value], kind: type | None = None) -> None:
        self.name = name
        self.call = call
        self.kind = kind

    def __repr__(self) -> str:
        return f"<function {self.name}>"


class Namespace:
    """What is reached behind a dot: `math`, `python` and `xacro`."""

    __slots__ = ("members", "name")

    def __init__(self, name: str, members: Mapping[str, Value]) -> None:
        self.name = name
        self.members = members


Kinds = frozenset[type[Any]]
SCALARS: Kinds = frozenset({bool, int, float, str, type(None)})
SEQUENCES: Kinds = frozenset({list, tuple, DotList})
_DATES: Kinds = frozenset({date, datetime, time})
MAPPINGS: Kinds = frozenset({dict, DotDict})
_EMPTY: dict[Any, Any] = {}
_GONE_THROUGH: Kinds = SEQUENCES | {set, frozenset, type(_EMPTY.keys()), type(_EMPTY.values()), type(_EMPTY.items())}
ITERATOR: type[Any] = type(iter([]))
"""What functions give that give an iterator in Python. It has no length there, and none here."""
# Exact types, because a subclass can override any method that is called on it here.
TYPES: Kinds = SCALARS | _DATES | MAPPINGS | _GONE_THROUGH | {range, ITERATOR, Function}
"""The exact types of all values; an instance of another, be it derived from one of these, is none."""


def kind_of(value: object) -> type[Any]:
    """The exact type of a value."""
    return type(value)


def weigh(value: Value, budget: Budget) -> None:
    """Refuse a value that is too large, counting what it has several times as often as it has it.

    Whoever looks at the whole of a value weighs it first, since Python would not come to an end: to write or compare
    `b = [a, a]`, `c = [b, b]` and so on takes twice as long for each.

    Raises:
        ExcessError: it is too large.
        RefusedError: something in it is no value.
    """
    items = characters = 0
    # `str(a)` of 26 lists, each of which stands twice in the next, takes Python 40 s, and `a == b`
    # 75 s.
    stack: list[Value] = [value]
    while stack:
        inner = stack.pop()
        items += 1
        kind = kind_of(inner)
        if kind is str:
            characters += len(inner)
        elif kind in MAPPINGS:
            stack.extend(inner)
            stack.extend(inner.values())
        elif kind in _GONE_THROUGH:
            stack.extend(inner)
        elif kind not in TYPES:
            raise ExpressionRefusedError(f"an expression must not use {_described(inner)}")
        if items + characters + len(stack) > LONGEST_TEXT:
            raise ExcessError(f"a value holds more than {LONGEST_TEXT:,} characters and items")
    budget.spend(1 + items // ITEMS_A_STEP + characters // CHARACTERS_A_STEP)


def text_of(value: Value, budget: Budget) -> str:
    """The text that Python has for a value."""
    if type(value) is str:
        return value
    weigh(value, budget)
    text = str(value)
    budget.pay(text)
    return text


def _described(value: object) -> str:
    return f"the namespace {value.name!r} as a value" if isinstance(value, Namespace) else "a namespace as a value"


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
