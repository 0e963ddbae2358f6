"""The order of frames in models of SDF: each behind what it is attached to and what its pose is in.

SDF leaves the order open. Drake 1.51 does not: it puts a frame that stands before its base at the wrong place.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from twinform.ir import Frame, Joint, Link, Model
from twinform.schemas import Item, NeedsTree, XmlElement

_Part = TypeVar("_Part")
_TAGS = frozenset({"link", "joint", "frame", "model"})
_NODES = (Link, Joint, Frame, Model)


_Names = tuple[str | None, tuple[str, ...]]
"""What a part of a model is called, if others may stand on it, and the names that it stands on."""
_NONE: _Names = (None, ())


class _Ordered(NamedTuple):
    """Parts in their order, and those that go round in a circle."""

    parts: list[Any]
    circular: list[Any]


def put_bases_first(model: XmlElement) -> None:
    """Put the frames of a model behind what they stand on, and change the order of nothing else."""
    children = list(model)
    ordered = _ordered(children, _names_of_element)
    # Only in documents that came from URDF, where the order is ours. An SDF file that stays SDF
    # keeps its order, also where Drake misreads it. A pass cannot do this: parts are written in the
    # order of the lines that they came from.
    if [*ordered.parts, *ordered.circular] != children:
        model[:] = [*ordered.parts, *ordered.circular]


def parts_with_bases_first(holder: Any, parts: list[Item]) -> list[Item]:
    """Put the frames among the parts of a model behind what they stand on; parts of other nodes stay.

    Raises:
        NeedsTree: frames go round in a circle. They stand behind all else in the model, and so behind untyped elements.
    """
    if not isinstance(holder, Model) or not holder.frames:
        return parts
    ordered = _ordered(parts, _names_of_node)
    if ordered.circular:
        raise NeedsTree
    return ordered.parts


def has_untyped_names(model: Model) -> bool:
    """Whether there is an untyped element in a model that frames may stand on."""
    names = (part.element.name for part in model.opaque if part.element is not None)
    return not _TAGS.isdisjoint(names) or any(map(has_untyped_names, model.models))


def _ordered(parts: list[_Part], names_of: Callable[[_Part], _Names]) -> _Ordered:
    named = [(part, names_of(part)) for part in parts]
    known = {name for _, (name, _) in named}
    waiting: dict[str, list[tuple[_Part, _Names]]] = {}
    done: set[str | None] = set()
    ordered: list[_Part] = []
    for pair in named:
        ready = [pair]
        while ready:
            part, (name, bases) = one = ready.pop()
            # Each part waits under one base that is missing, and is looked at again when that one
            # is there: linear, however long the chains are.
            base = next((base for base in bases if base in known and base not in done), None) if bases else None
            if base is not None:
                waiting.setdefault(base, []).append(one)
                continue
            ordered.append(part)
            if name is not None:
                done.add(name)
                ready += reversed(waiting.pop(name, []))
    return _Ordered(ordered, [part for many in waiting.values() for part, _ in many])


def _names_of_element(part: XmlElement) -> _Names:
    if part.tag not in _TAGS:
        return _NONE
    name = str(part.get("name"))
    if part.tag != "frame":
        return name, ()
    pose = part.find("pose")
    return name, _bases(part.get("attached_to"), pose.get("relative_to") if pose is not None else None)


def _names_of_node(item: Item) -> _Names:
    node = item[0]
    if not isinstance(node, _NODES):
        return _NONE
    if not isinstance(node, Frame):
        return node.name, ()
    return node.name, _bases(node.attached_to, node.pose.relative_to if node.pose is not None else None)


def _bases(*names: str | None) -> tuple[str, ...]:
    """What of the same model a frame needs to be there."""
    return tuple([name.partition("::")[0] for name in names if name])
