"""Applies the changes that a ledger lists to a document, without the code of any pass.

Shapes that collide are not written: the links that have others are told by `reshaped`, so that they can be left out.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from twinform.diagnostics import PhysicsChange, ValueChange
from twinform.ir import Document

_STEP = re.compile(r"(\w+)(?:\[(.*?)\])?(?=/|$)")
_Part = dict[str, Any]
_SHAPES = "collisions"


class NotApplicableError(Exception):
    """The ledger names a part or a value that the document does not have."""


def reshaped(changes: Iterable[PhysicsChange]) -> frozenset[str]:
    """The names, without those of models around, of the links of which the ledger says that other shapes collide."""
    listed = (each for each in changes if any(_is_shape(value) for value in each.values))
    return frozenset(each.name.rpartition("::")[2] for each in listed)


def _is_shape(value: ValueChange) -> bool:
    return value.path.startswith(_SHAPES)


def applied(document: Document, changes: Iterable[PhysicsChange]) -> Document:
    """The document with every value as the ledger has it, but for shapes.

    Raises:
        NotApplicableError: a value was another one than the ledger says, or a part is new or gone.
    """
    whole: _Part = document.model_dump()
    for change in changes:
        part = _find(whole, change)
        for value in change.values:
            if not _is_shape(value):
                _set(part, value)
    return Document.model_validate(whole)


def _find(whole: _Part, change: PhysicsChange) -> _Part:
    found = [part for name, part in _parts(whole, f"{change.part}s") if name == change.name]
    if len(found) != 1:
        raise NotApplicableError(f"there are {len(found)} parts called {change.name}")
    return found[0]


def _parts(whole: _Part, kind: str) -> Iterator[tuple[str, _Part]]:
    for model in whole["models"]:
        yield from _inside(model, kind, "")
    for world in whole["worlds"]:
        for model in world["models"]:
            yield from _inside(model, kind, f"{world['name']}::{model['name']}::")


def _inside(model: _Part, kind: str, scope: str) -> Iterator[tuple[str, _Part]]:
    for part in model[kind]:
        yield scope + part["name"], part
    for nested in model["models"]:
        yield from _inside(nested, kind, f"{scope}{nested['name']}::")


def _set(part: _Part, value: ValueChange) -> None:
    """Write one value; nodes on the way to it that are not there are made."""
    steps = _STEP.findall(value.path)
    if not steps:
        raise NotApplicableError(f"the part itself is {'gone' if value.now is None else 'new'}")
    *way, (last, _) = steps
    holder = part
    for name, label in way:
        holder = _entered(holder, name, label)
    if holder.get(last) != value.was:
        raise NotApplicableError(f"{value.path} is {holder.get(last)} and not {value.was}")
    holder[last] = value.now


def _entered(holder: _Part, name: str, label: str) -> _Part:
    """The node of a name in another one, made if it is not there; of several, the one with a label."""
    if not label:
        holder[name] = holder.get(name) or {}
        return holder[name]
    many: Sequence[_Part] = holder.get(name) or ()
    for number, each in enumerate(many):
        if label in (repr(each.get("name")), str(number)):
            return each
    raise NotApplicableError(f"there is no {name}[{label}]")
