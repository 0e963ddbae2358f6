"""HTML of values for notebooks: `twinform/__init__.py` says who draws each class, a report that stands above it."""

from importlib import import_module

TYPE_CHECKING = False  # as in `twinform/__init__.py`
if TYPE_CHECKING:
    from collections.abc import Callable

DRAWN_BY: "dict[str, tuple[str, str]]" = {}
"""The module and the function that draw a value, by the name of its class."""


def draw(kind: str, value: object) -> str:
    """Return the HTML of a value of this class."""
    module, function = DRAWN_BY[kind]
    drawing: Callable[[object], str] = getattr(import_module(module), function)
    return drawing(value)
