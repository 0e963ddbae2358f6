"""Lists of numbers in the attributes of MJCF: read and written."""

from collections.abc import Iterable

from twinform.schemas import XmlElement

Numbers = tuple[float, ...]


def numbers_of(element: XmlElement, name: str, default: Numbers | None = None, *, count: int = 0) -> Numbers | None:
    """Return the numbers of an attribute.

    The default stands for an attribute that is not there, for text that is no list of numbers, and for a list of fewer
    numbers than `count`: the reader of the schema has reported it.
    """
    text = element.get(name)
    if text is None:
        return default
    found = parse_numbers(text)
    return default if found is None or len(found) < count else found


def parse_numbers(text: str) -> Numbers | None:
    """Return the numbers of a text, or None where it is no list of numbers."""
    try:
        return tuple(map(float, text.split()))
    except ValueError:
        return None


def number_text(numbers: Iterable[float]) -> str:
    """Write numbers so that they are read back to the last bit."""
    return " ".join(_written(number) for number in numbers)


def _written(number: float) -> str:
    text = repr(number + 0.0)  # -0.0 becomes 0.0
    return text.removesuffix(".0")
