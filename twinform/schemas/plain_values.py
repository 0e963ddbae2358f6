"""Plain values: those that need no finding and are stored as they are, as nearly all are.

A row of which values can be plain has a `PlainValue`. Every other value goes to the reader of the row in
`value_readers.py`, which asks each question by itself and reports the answer.
"""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from twinform.schemas.facts import Fact, Version
from twinform.schemas.node_makers import Data
from twinform.schemas.value_readers import SCALARS, Types, bounds, own_field, stripped

NOT_PLAIN = (ValueError, KeyError, TypeError, AttributeError)
"""What a parser raises; the last two where there is no text."""
_USUAL_BOOLS = {"true": True, "false": False}
"""Of the others, the node remembers the spelling."""


class PlainValue(NamedTuple):
    """How the values of a row are recognized as plain.

    `parse` raises one of `NOT_PLAIN` for other texts; where `is_usual` is there, a value is plain if that says so.
    """

    field: str
    parse: Callable[[Any], Any]
    is_usual: Callable[[Any], bool] | None


def plain_values(rows: Iterable[Fact], types: Types, version: Version) -> dict[str, PlainValue]:
    """The rows of attributes or children that need no finding themselves and have nothing but a value, by name."""
    return {
        row.name.removeprefix("@"): PlainValue(field, _parser(row, types), _usual_values(row))
        for row in rows
        if row.exists_in(version) and not (row.dialect or row.deprecated or row.aside or row.rows)
        if row.type not in {None, "pose"} and (field := own_field(row))
    }


def store_plain(plain: PlainValue, text: str | None, node: Data) -> bool:
    """Store the value of a text, if it is plain; whether it was."""
    field, parse, is_usual = plain
    try:
        value = parse(text)
    except NOT_PLAIN:
        return False
    if is_usual is not None and not is_usual(value):
        return False
    node[field] = value
    return True


def _parser(row: Fact, types: Types) -> Callable[[Any], Any]:
    if row.type == "string":
        return str if row.is_attribute else stripped
    return _USUAL_BOOLS.__getitem__ if row.type == "bool" else types[str(row.type)].parse


def _usual_values(row: Fact) -> Callable[[Any], bool] | None:
    """What tells that nothing is wrong with a value; None where nothing can be."""
    if row.enum:
        return frozenset(row.enum).__contains__
    if row.min is None and row.max is None:
        return bool if row.type == "string" and not row.is_attribute else None  # blank text may need a finding
    low, high = bounds(row)
    if row.type in SCALARS:
        return lambda value: low <= value <= high
    return lambda value: low <= min(value) and max(value) <= high
