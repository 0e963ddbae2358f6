"""What the children of an XML element are called, and whether two elements say the same."""

from hashlib import sha256

from twinform.schemas import XmlElement

_NAMES = ("name", "reference", "link", "joint")
"""Attributes that tell one child from another of the same tag."""


def keyed(parent: XmlElement) -> dict[str, XmlElement]:
    """The children by tag, by name where they have one, and by number where that is not enough: `visual[front] 2`."""
    found: dict[str, XmlElement] = {}
    count: dict[str, int] = {}
    for child in parent:
        name = next((value for each in _NAMES if (value := child.get(each)) is not None), None)
        key = str(child.tag) if name is None else f"{child.tag}[{name}]"
        number = count[key] = count.get(key, 0) + 1
        found[key if number == 1 else f"{key} {number}"] = child
    return found


def stripped(text: str | None) -> str:
    """A text without the white space around it; that of nothing is empty."""
    return (text or "").strip()


def same(one: XmlElement, other: XmlElement) -> bool:
    """Whether two elements are equal but for white space around texts."""
    return (
        one.tag == other.tag
        and len(one) == len(other)
        and stripped(one.text) == stripped(other.text)
        and one.items() == other.items()
        and stripped(one.tail) == stripped(other.tail)
        and all(map(same, one, other))
    )


def digest(element: XmlElement) -> str:
    """A short fingerprint of what an element says; equal for those that are `same`."""
    return sha256(repr(_said(element)).encode()).hexdigest()[:12]


def _said(element: XmlElement) -> tuple[object, ...]:
    attributes = [(str(name), str(value)) for name, value in element.items()]
    inside = [_said(child) for child in element]
    return (str(element.tag), attributes, stripped(element.text), stripped(element.tail), inside)
