"""HTML that escapes by type, so that no text of a file can become a tag; tables, bars and numbers made of it."""

import math
from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape
from typing import NamedTuple

from twinform.diagnostics import Fate, Ledger, Location
from twinform.diagnostics.reporters import printable
from twinform.lazy import lazy_pattern

_WITHOUT_END = frozenset({"meta", "img", "br", "wbr"})
_LINES = frozenset({"\n", "\t"})
_PIECES = lazy_pattern(r"[^/_:.]*[/_:.]*")


# With templates each place has to be escaped, or an engine with autoescape be installed. Here a
# type checker and one property test hold that no plain `str` becomes HTML.
class Markup(str):
    """A text that is HTML; any other text is escaped."""

    __slots__ = ()


Part = Markup | str | None
"""A part of an element; None is nothing."""
Value = str | int | float | bool | None
"""The value of an attribute: with True it is written without a value, with None or False it is left out."""


def element(tag: str, *parts: Part, **attributes: Value) -> Markup:
    """Make an element; `_` in the name of an attribute becomes `-`, and is dropped at the end, as in `class_`."""
    words = [tag]
    for written, value in attributes.items():
        name = written.rstrip("_").replace("_", "-")
        if value is True:
            words.append(name)
        elif value is not None and value is not False:
            words.append(f'{name}="{plain(str(value))}"')
    start = f"<{' '.join(words)}>"
    return Markup(start) if tag in _WITHOUT_END else Markup(f"{start}{join(parts)}</{tag}>")


def join(parts: Iterable[Part], between: Markup | str = "") -> Markup:
    """Join parts, and leave out empty ones."""
    return Markup(_markup(between).join(_markup(part) for part in parts if part))


def _markup(part: Markup | str) -> Markup:
    return part if isinstance(part, Markup) else plain(part)


def plain(text: str) -> Markup:
    """Escape a text: what HTML gives a meaning to, and characters that cannot be shown."""
    if not text.isprintable():
        text = "".join(each if each in _LINES else printable(each) for each in text)
    return Markup(escape(text))


def breakable(text: str) -> Markup:
    """Let the browser break a name or path between its words; by itself it breaks anywhere or nowhere."""
    return join(filter(None, map(plain, _PIECES.findall(text))), between=element("wbr"))


def image(drawing: str, **attributes: Value) -> Markup:
    """Embed an SVG as an image, so that its styles do not reach the page."""
    data = b64encode(drawing.encode()).decode()
    return element("img", src=f"data:image/svg+xml;base64,{data}", **attributes)


MOST_ROWS = 2000
"""Longer tables are cut, and say so."""


class Cell(NamedTuple):
    """A cell with a number that its column can be sorted by."""

    text: Part
    value: float | None = None


def number(value: float | None) -> Cell:
    """Make a cell of a number; an empty one if the number is not known."""
    if value is None:
        return Cell(None)
    return Cell(f"{value:.4g}" if math.isfinite(value) else "unbounded", value)


def count(amount: int, word: str) -> str:
    """Write an amount of something, such as `1 line` or `2,000 lines`."""
    return f"{amount:,} {word}{'' if amount == 1 else 's'}"


def fates(ledger: Ledger) -> str:
    """Write how many parts of a source met each fate."""
    return ", ".join((f"{ledger.expressed:,} expressed", *(f"{ledger.count(fate):,} {fate.value}" for fate in Fate)))


def bar(value: float, most: float, second: float | None = None) -> Markup:
    """Draw a bar for a value between zero and `most`, in front of a pale one for a second value."""
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
    """Make a table; the first column names the rows, and `total` is the last row."""
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
    # the keyboard has to reach what scrolls
    scroller = element("div", made, class_="scroller", tabindex="0", role="region", aria_label=caption)
    return join((scroller, more))


def _head(text: str, *, sortable: bool) -> Markup:
    if not text:
        return element("td")
    return element("th", element("button", text, type="button") if sortable else text, scope="col")


def _row(cells: Sequence[Cell | Part]) -> Markup:
    first, *rest = cells
    name = first.text if isinstance(first, Cell) else first
    name = name if name is None or isinstance(name, Markup) else breakable(name)
    return element("tr", element("th", name, scope="row"), *map(_cell, rest))


def _cell(cell: Cell | Part) -> Markup:
    if isinstance(cell, Cell):
        value = repr(float(cell.value)) if cell.value is not None else None
        return element("td", cell.text, class_="number", data_value=value)
    return element("td", cell)


def place(where: Location, file: str) -> str:
    """Write a place in a file as editors read it, `file:line:column`; nothing if it is not known."""
    if not where.line:
        return where.file or file if not where.path else ""
    column = f":{where.column}" if where.column else ""
    return f"{where.file or file}:{where.line}{column}"


def folded(title: Part, *parts: Part, open_: bool = False, class_: str | None = None) -> Markup:
    """Make a part of the page that can be unfolded."""
    return element("details", element("summary", title), *parts, open=open_, class_=class_)
