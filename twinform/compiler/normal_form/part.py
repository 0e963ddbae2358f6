"""The parts of a normal form."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from twinform.compiler.compare.values import Value
from twinform.schemas import XmlElement

TEXT = ""
"""The name of the value that is the text of an element."""


class Key(NamedTuple):
    """What tells a part from its siblings: its tag, its name if it has one, and its number among those of both."""

    tag: str
    name: str
    number: int


@dataclass(slots=True)
class Part:
    """An element, and what it says that is no default.

    `values` are those of its attributes (`@name`), its text (`TEXT`) and its pose (`pose`). Where it is
    `ordered`, the order of its children counts.
    """

    element: XmlElement
    ordered: bool = False
    values: dict[str, Value] = field(default_factory=dict[str, Value])
    children: dict[Key, "Part"] = field(default_factory=dict[Key, "Part"])
    _counts: dict[tuple[str, str], int] = field(default_factory=dict[tuple[str, str], int])

    @property
    def says_nothing(self) -> bool:
        """Whether there is nothing in it."""
        return not self.values and not self.children

    def next_key(self, tag: str, name: str) -> Key:
        """The key of the next child of this tag and name."""
        count = self._counts[tag, name] = self._counts.get((tag, name), 0) + 1
        return Key(tag, name, count)


def text_of(element: XmlElement) -> str:
    """The text of an element; that between its children too, which is a mistake in most."""
    return " ".join(filter(None, _pieces(element)))


def _pieces(element: XmlElement) -> Iterator[str]:
    yield (element.text or "").strip()
    for child in element:
        yield (child.tail or "").strip()
