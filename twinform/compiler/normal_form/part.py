"""The elements of a normal form, and how repeated `<gazebo>` elements are merged into one."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from twinform.compiler.compare.compared_values import Value
from twinform.compiler.normal_form.value_meanings import literally
from twinform.schemas import XmlElement

TEXT = ""
"""The name of the value that is the text of an element."""


class Key(NamedTuple):
    """What tells a part from its siblings: its tag, its name if it has one, and its number among those of both."""

    tag: str
    name: str
    number: int


@dataclass(slots=True)
class NormalPart:
    """An element with its values that are not the default.

    `values` are those of its attributes (`@name`), its text (`TEXT`) and its pose (`pose`). Where it is
    `ordered`, the order of its children counts.
    """

    element: XmlElement
    ordered: bool = False
    values: dict[str, Value] = field(default_factory=dict[str, Value])
    children: dict[Key, "NormalPart"] = field(default_factory=dict[Key, "NormalPart"])
    _counts: dict[tuple[str, str], int] = field(default_factory=dict[tuple[str, str], int])

    @property
    def is_empty(self) -> bool:
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


def tag_part(tag: XmlElement, value: Value | None) -> NormalPart:
    """A tag of an extension: its value, and attributes that mean nothing."""
    values = {f"@{name}": literally(str(text)) for name, text in tag.items() if name != "value"}
    return NormalPart(tag, values=values if value is None else {**values, TEXT: value})


def add_once(made: NormalPart, tag: str, part: NormalPart) -> None:
    """Add a part unless an equal one is there: repetitions of some tags mean nothing."""
    if not any(one.values == part.values for key, one in made.children.items() if key.tag == tag):
        made.children[_free_key(made, tag, "")] = part


def pool(made: NormalPart, tag: str, part: NormalPart) -> None:
    """Take in one of several elements that add to one thing, such as two `<collision>`."""
    key = Key(tag, "", 1)
    mine = made.children.get(key)
    if mine is None:
        if not part.is_empty:
            made.children[key] = part
        return
    mine.values = {**part.values, **mine.values}
    for inner, child in part.children.items():
        if inner.name:
            mine.children[_free_key(mine, inner.tag, inner.name)] = child
        elif child.children:
            pool(mine, inner.tag, child)
        else:
            add_once(mine, inner.tag, child)


def _free_key(made: NormalPart, tag: str, name: str) -> Key:
    return Key(tag, name, 1 + sum(1 for key in made.children if (key.tag, key.name) == (tag, name)))
