"""Applies the changes that a ledger lists to a document, without the code of any pass."""

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from twinform.diagnostics import PhysicsChange, ValueChange
from twinform.ir import Document

_STEP = re.compile(r"(\w+)(?:\[(.*?)\])?(?=/|$)")
_Part = dict[str, Any]


class NotApplicableError(Exception):
    """The ledger names a part or a value that the document does not have."""


def applied(document: Document, changes: Iterable[PhysicsChange]) -> Document:
    """The document with every value as the ledger has it.

    Raises:
        NotApplicableError: a value was another one than the ledger says, or a part is new or gone.
    """
    whole: _Part = document.model_dump()
    for change in changes:
        part = _find(whole, change)
        for value in change.values:
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
