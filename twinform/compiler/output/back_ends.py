"""The back ends: from the IR to the text of a URDF or SDF file.

In models of SDF that come from URDF, each frame is written behind the parts that it is attached to or posed in. SDF
leaves the order open, but Drake 1.51 puts a frame that stands before its base at the wrong place.
"""

from collections.abc import Iterable
from typing import Any

from twinform.diagnostics import Source
from twinform.ir import Document, Element, Frame, Joint, Link, Model, Opaque
from twinform.schemas import Item, Version, WrittenParts, print_version, root_text

_TAGS = frozenset({"link", "joint", "frame", "model"})
_NODES = (Link, Joint, Frame, Model)
_Names = tuple[str | None, tuple[str, ...]]
"""The name of a part, if others may be based on it, and the names of the parts that it is based on."""
_NONE: _Names = (None, ())
# Stands for an untyped element, which is written behind the typed ones.
_WRITTEN: Item = (None, None)


# Only in documents that came from URDF, where the order is ours. An SDF file that stays SDF
# keeps its order, also where Drake misreads it. A pass cannot do this: parts are written in the
# order of the lines that they came from.
class _BaseOrder:
    """Orders parts so that each comes after its bases."""

    def __init__(self, names: set[str | None]) -> None:
        self.names = names
        self.done: set[str | None] = set()
        self.waiting: dict[str, list[tuple[Item, _Names]]] = {}

    def place(self, named: list[tuple[Item, _Names]]) -> list[Item]:
        """Return these parts, without those that have to wait, and with those that waited for them."""
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
        """The parts that still wait, because their bases go round in a circle."""
        return [item for many in self.waiting.values() for item, _ in many]


def with_bases_first(holder: Any, items: list[Item]) -> tuple[list[Item], list[Item]]:
    """Return the parts of a model in their order, and those that are written behind all others.

    The latter are based on an element without a typed form, which is written behind the typed ones, or go round in a
    circle. The parts of anything but a model stay as they are.
    """
    if isinstance(holder, Model):
        untyped = [part.element for part in holder.opaque if part.element is not None]
        return _order_by_bases(items, untyped) if holder.frames else (items, [])
    return _order_by_bases(items, ()) if holder.__class__ is Element and holder.name == "model" else (items, [])


def _order_by_bases(items: list[Item], others: Iterable[Element]) -> tuple[list[Item], list[Item]]:
    named = [(item, _names_of(item[0])) for item in items]
    untyped = [_names_of(other) for other in others]
    order = _BaseOrder({name for _, (name, _) in named} | {name for name, _ in untyped})
    first = order.place(named)
    late = order.place([(_WRITTEN, names) for names in untyped])
    return first, [item for item in (*late, *order.circular) if item is not _WRITTEN]


def _names_of(part: Any) -> _Names:
    if isinstance(part, Element):
        return _names_of_untyped(part)
    if not isinstance(part, _NODES):
        return _NONE
    if not isinstance(part, Frame):
        return part.name, ()
    return part.name, _base_names(part.attached_to, part.pose.relative_to if part.pose is not None else None)


def _names_of_untyped(part: Element) -> _Names:
    if part.name not in _TAGS:
        return _NONE
    name = str(part.get("name"))
    if part.name != "frame":
        return name, ()
    pose = part.find("pose")
    return name, _base_names(part.get("attached_to"), pose.get("relative_to") if pose is not None else None)


def _base_names(*names: str | None) -> tuple[str, ...]:
    """Return the parts of the model that a frame is based on."""
    return tuple([name.partition("::")[0] for name in names if name])


def sdf_text(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """Write a document as SDF. Models that were read from SDF keep their order."""
    arrange = with_bases_first if _has_robots(document) else None
    return root_text("sdf", version, document, namespaces, arrange=arrange, parts=parts)


def _has_robots(document: Document) -> bool:
    """Whether a model of a document comes from URDF."""
    return any(model.source and _is_of_urdf(model.source) for model in document.models)


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"


def urdf_text(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """Write a document of one model as URDF."""
    model = document.models[0]
    if document.version is not None:  # as an untyped attribute it is behind the others, and instead of another version
        attribute = Opaque.unchecked(attribute=("version", print_version(version)))
        model = model.copy(opaque=(*model.opaque, attribute))
    return root_text("urdf", version, model, namespaces, parts=parts)
