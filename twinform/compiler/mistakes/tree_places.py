"""Places and values of elements of the tree that `check` looks at where the IR keeps them as they are."""

import math

from twinform.diagnostics import Location
from twinform.schemas import XmlElement, path_of


def place_of(element: XmlElement) -> Location:
    """Where an element was written."""
    return Location("", element.sourceline or 0, path_of(element))


def text_of(element: XmlElement | None) -> str:
    """The text of an element without blanks around it; empty where there is none."""
    return (element.text or "").strip() if element is not None else ""


def number_of(element: XmlElement | None) -> float | None:
    """The number in an element; None where there is none, which the schema reports, or none that is finite."""
    try:
        value = float(text_of(element))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def tag_of(element: XmlElement | None) -> str:
    """The name of an element; empty for comments and where there is none."""
    return element.tag if element is not None and isinstance(element.tag, str) else ""
