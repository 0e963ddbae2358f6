"""Pieces of HTML that several sections have: numbers, bars, tables, places in files."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from twinform.diagnostics import Location
from twinform.report.markup import Markup, Part, breakable, element, join

MOST_ROWS = 2000
"""Longer tables are cut, and say so."""


class Cell(NamedTuple):
    """A cell with a number by which its column is sorted."""

    text: Part
    value: float | None = None


def number(value: float | None) -> Cell:
    """A number as a cell; nothing where it is not known."""
    if value is None:
        return Cell(None)
    return Cell(f"{value:.4g}" if math.isfinite(value) else "unbounded", value)


def count(amount: int, word: str) -> str:
    """An amount of something in words."""
    return f"{amount:,} {word}{'' if amount == 1 else 's'}"


def bar(value: float, most: float, second: float | None = None) -> Markup:
    """A bar for a value between zero and `most`, before a pale one for a second value; the numbers stand beside it."""
    rects = [_rect(second, most, "pale")] if second is not None else []
    return element(
        "svg", *rects, _rect(value, most, "full"), class_="bar", width="100%", height="12", aria_hidden="true"
    )


def _rect(value: float, most: float, class_: str) -> Markup:
    share = 100 * min(value / most, 1.0) if most > 0 and math.isfinite(most) and value > 0 else 0.0
    return element("rect", class_=class_, width=f"{share:.2f}%", height="12", rx="2")


def table(
    caption: str,
    heads: Sequence[str],
    rows: Iterable[Sequence[Cell | Part]],
    *,
    sortable: bool = False,
    total: Part = None,
) -> Markup:
    """A table whose first column has the names of its rows; `total` is the row below it."""
    listed = list(rows)
    left = len(listed) - MOST_ROWS
    head = element("tr", *(_head(each, sortable=sortable) for each in heads))
    body = element("tbody", *(_row(row) for row in listed[:MOST_ROWS]))
    more = element("p", f"and {count(left, 'more row')}") if left > 0 else None
    made = element(
        "table",
        element("caption", element("span", caption)),
        element("thead", head),
        body,
        element("tfoot", total) if total else None,
        class_="sortable" if sortable else None,
    )
    # what scrolls has to be reachable by the keyboard
    scroller = element("div", made, class_="scroller", tabindex="0", role="region", aria_label=caption)
    return join((scroller, more))


def _head(text: str, *, sortable: bool) -> Markup:
    if not text:
        return element("td")
    return element("th", element("button", text, type="button") if sortable else text, scope="col")


def _row(cells: Sequence[Cell | Part]) -> Markup:
    first, *rest = cells
    return element("tr", element("th", _name(first), scope="row"), *map(_cell, rest))


def _cell(cell: Cell | Part) -> Markup:
    if isinstance(cell, Cell):
        value = repr(float(cell.value)) if cell.value is not None else None
        return element("td", cell.text, class_="number", data_value=value)
    return element("td", cell)


def _name(cell: Cell | Part) -> Part:
    text = cell.text if isinstance(cell, Cell) else cell
    return text if text is None or isinstance(text, Markup) else breakable(text)


def place(where: Location, file: str) -> str:
    """A place in a file as an editor takes it; nothing where it is not known."""
    if not where.line:
        return where.file or file if not where.path else ""
    column = f":{where.column}" if where.column else ""
    return f"{where.file or file}:{where.line}{column}"


def folded(title: Part, *parts: Part, open_: bool = False, class_: str | None = None) -> Markup:
    """What can be unfolded."""
    return element("details", element("summary", title), *parts, open=open_, class_=class_)
