"""What the facts tables know by name alone: which values are numbers, and the usual order of attributes.

A formatter sees parts of models, such as the body of a xacro macro, of which nothing says where they will stand. So an
element is known by its name, and counts as a number only where it is one wherever a format has that name.
"""

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

from twinform.schemas import Fact, table

_NUMBERS = frozenset({"double", "vector2d", "vector3", "quaternion", "color", "color4", "pose"})
_FORMATS = ("urdf", "sdf")
_Key = TypeVar("_Key", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Usage:
    """Names of elements, and of attributes in them.

    `opaque` are the elements with contents of their own, such as plugins, in which nothing is known.
    """

    numeric_attributes: frozenset[tuple[str, str]]
    numeric_texts: frozenset[str]
    opaque: frozenset[str]
    order: dict[str, tuple[str, ...]]

    def rank(self, element: str, attribute: str) -> int:
        """A number that is smaller for what usually stands further in front."""
        if attribute == "name":
            return -1
        known = self.order.get(element, ())
        return known.index(attribute) if attribute in known else len(known)


@cache
def usage() -> Usage:
    """Return the usage of names in both formats and all versions."""
    elements = [element for format in _FORMATS for element in _elements(format)]
    order: dict[str, dict[str, None]] = {}
    for name, _, fact in elements:
        order.setdefault(name, {}).update((row.name[1:], None) for row in fact.attributes)
    return Usage(
        _numeric(((name, row.name[1:]), row.type) for name, _, fact in elements for row in fact.attributes),
        _numeric((name, type) for name, type, _ in elements),
        frozenset(name for name, _, fact in elements if fact.any),
        {name: tuple(attributes) for name, attributes in order.items()},
    )


def _numeric(typed: Iterable[tuple[_Key, str | None]]) -> frozenset[_Key]:
    """What has numbers wherever it has a value."""
    found = list(typed)
    others = {key for key, type in found if type and type not in _NUMBERS}
    return frozenset({key for key, type in found if type} - others)


def _elements(format: str) -> Iterator[tuple[str, str | None, Fact]]:
    """Each element of a format by its name, with the type of its text and the fact that holds its rows."""
    facts = table(format)
    pending = [facts.definitions[facts.root]]
    seen: set[int] = set()
    yield facts.root, None, pending[0]
    while pending:
        fact = pending.pop()
        if id(fact) in seen:
            continue
        seen.add(id(fact))
        for row in fact.children:
            inner = facts.resolve(row)
            yield row.name, row.type or inner.type, inner
            pending.append(inner)
