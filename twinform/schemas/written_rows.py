"""Which rows of the facts a node is written by, and the order of parts of several kinds."""

from collections.abc import Iterable
from functools import cache
from operator import itemgetter
from typing import Any, TypeVar

from twinform.schemas.facts import Fact, Version, rows_by_name, table

_Each = TypeVar("_Each")


def rows_to_write(rows: Iterable[Fact], version: Version) -> list[Fact]:
    """Choose one row with a place in the node for each name: this version's if it has one."""
    placed = (row for row in rows if row.place and row.place[0] != "/")
    return list(rows_by_name(placed, version).values())


def makes_many(row: Fact) -> bool:
    """Tell whether the field of a row holds any number of nodes, written in the order of the file."""
    return row.fills_tuple and row.type is None


@cache
def repeated_fields(format: str, definition: str) -> tuple[str, ...]:
    """The fields of a definition that hold any number of nodes, in the order in which they are written."""
    facts = table(format)
    if definition not in facts.definitions:
        return ()
    rows = rows_to_write(facts.definitions[definition].rows, facts.newest)
    return tuple(row.place or "" for row in rows if makes_many(row))


def in_order(items: list[tuple[Any, _Each]]) -> list[tuple[Any, _Each]]:
    """Sort children by the lines that they came from; one without a line of this file follows the one before it."""
    if len(items) < 2:
        return items
    keys: list[int] = []
    file, line = None, 0
    for child, _ in items:
        source = child.source
        if source is not None:
            file = source.file if file is None else file
            line = source.line if source.file == file else line
        # Links and joints are separate tuples in the IR, but most authors write them in turns.
        keys.append(line)
    return [item for _, item in sorted(zip(keys, items, strict=True), key=itemgetter(0))]
