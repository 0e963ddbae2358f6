"""The order of frames in models of SDF: each behind what it is attached to and what its pose is in.

SDF leaves the order open. Drake 1.51 does not: it puts a frame that stands before its base at the wrong place.
"""

from collections.abc import Iterable
from typing import Any

from twinform.ir import Element, Frame, Joint, Link, Model
from twinform.schemas import Item

_TAGS = frozenset({"link", "joint", "frame", "model"})
_NODES = (Link, Joint, Frame, Model)
_Names = tuple[str | None, tuple[str, ...]]
"""What a part of a model is called, if others may stand on it, and the names that it stands on."""
_NONE: _Names = (None, ())
# Stands for an untyped element, which is written behind the typed ones.
_WRITTEN: Item = (None, None)


# Only in documents that came from URDF, where the order is ours. An SDF file that stays SDF
# keeps its order, also where Drake misreads it. A pass cannot do this: parts are written in the
# order of the lines that they came from.
class _Order:
    """Places parts one after another, those that stand on another one once that is placed."""

    def __init__(self, names: set[str | None]) -> None:
        self.names = names
        self.done: set[str | None] = set()
        self.waiting: dict[str, list[tuple[Item, _Names]]] = {}

    def placed(self, named: list[tuple[Item, _Names]]) -> list[Item]:
        """These parts, without those that have to wait, and with those that waited for them."""
        made: list[Item] = []
        for pair in named:
            ready = [pair]
            while ready:
                item, (name, bases) = one = ready.pop()
                # Each part waits under one base that is missing, and is looked at again when that
                # one is there: linear, however long the chains are.
                base = next((base for base in bases if self._is_awaited(base)), None) if bases else None
                if base is not None:
                    self.waiting.setdefault(base, []).append(one)
                    continue
                made.append(item)
                if name is not None:
                    self.done.add(name)
                    ready += reversed(self.waiting.pop(name, []))
        return made

    def _is_awaited(self, name: str) -> bool:
        return name in self.names and name not in self.done

    @property
    def circular(self) -> list[Item]:
        """The parts that still wait."""
        return [item for many in self.waiting.values() for item, _ in many]


def with_bases_first(holder: Any, items: list[Item]) -> tuple[list[Item], list[Item]]:
    """The parts of a model in their order, and those that stand behind all others; what is no model stays as it is.

    The latter are attached to an element without a typed form, which is written behind what has one, or go round in a
    circle.
    """
    if isinstance(holder, Model):
        untyped = [part.element for part in holder.opaque if part.element is not None]
        return _ordered(items, untyped) if holder.frames else (items, [])
    return _ordered(items, ()) if holder.__class__ is Element and holder.name == "model" else (items, [])


def _ordered(items: list[Item], others: Iterable[Element]) -> tuple[list[Item], list[Item]]:
    named = [(item, _names_of(item[0])) for item in items]
    untyped = [_names_of(other) for other in others]
    order = _Order({name for _, (name, _) in named} | {name for name, _ in untyped})
    first = order.placed(named)
    late = order.placed([(_WRITTEN, names) for names in untyped])
    return first, [item for item in (*late, *order.circular) if item is not _WRITTEN]


def _names_of(part: Any) -> _Names:
    if isinstance(part, Element):
        return _names_of_untyped(part)
    if not isinstance(part, _NODES):
        return _NONE
    if not isinstance(part, Frame):
        return part.name, ()
    return part.name, _bases(part.attached_to, part.pose.relative_to if part.pose is not None else None)


def _names_of_untyped(part: Element) -> _Names:
    if part.name not in _TAGS:
        return _NONE
    name = str(part.get("name"))
    if part.name != "frame":
        return name, ()
    pose = part.find("pose")
    return name, _bases(part.get("attached_to"), pose.get("relative_to") if pose is not None else None)


def _bases(*names: str | None) -> tuple[str, ...]:
    """What of the same model a frame needs to be there."""
    return tuple([name.partition("::")[0] for name in names if name])
