"""HTML that escapes by type: what is no `Markup` is text, so no name of a file can become a tag."""

import re
from collections.abc import Iterable
from html import escape

from twinform.diagnostics.reporters import printable

_WITHOUT_END = frozenset({"meta", "img", "br", "wbr"})
_LINES = frozenset({"\n", "\t"})
_PIECES = re.compile(r"[^/_:.]*[/_:.]*")


# With templates each place has to be escaped, or an engine with autoescape be installed. Here a
# type checker and one property test hold that no plain `str` becomes HTML.
class Markup(str):
    """A text that is HTML already."""

    __slots__ = ()


Part = Markup | str | None
"""What stands in an element; None is nothing."""
Value = str | int | float | bool | None
"""Of an attribute: true is one without a value, and None or false none at all."""


def element(tag: str, *parts: Part, **attributes: Value) -> Markup:
    """An element; in the names of attributes `_` is `-`, and one at the end is left out, as in `class_`."""
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
    """Several parts as one."""
    return Markup(_markup(between).join(_markup(part) for part in parts if part))


def _markup(part: Markup | str) -> Markup:
    return part if isinstance(part, Markup) else plain(part)


def plain(text: str) -> Markup:
    """A text, with an escape for what a browser would obey or could not show."""
    if not text.isprintable():
        text = "".join(each if each in _LINES else printable(each) for each in text)
    return Markup(escape(text))


def breakable(text: str) -> Markup:
    """A name or path that may be broken between its words, which browsers break anywhere or nowhere."""
    return join(filter(None, map(plain, _PIECES.findall(text))), between=element("wbr"))
