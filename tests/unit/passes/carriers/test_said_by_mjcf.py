"""What MJCF is said to say of SDF is written, and all else is carried: each field of each node is changed in turn."""

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

import twinform
from twinform.ir import Document, Joint, Limit, Node, rewrite, walk
from twinform.ir.node import NOT_CONTENT, are_nodes
from twinform.ir.record import fields_of
from twinform.passes.carriers.partial_nodes import IDENTITY
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf, said_of_limit

_FILE = Path(__file__).parent / "every_field.sdf"
_CARRIER = re.compile(r'\s*<text name="[^"]*twinform:[^>]*/>')
_APART = NOT_CONTENT | {"kind", "opaque"}
_MOST = 2
"""So many changes of one field are tried that make another valid document."""
_WORDS: Mapping[str, tuple[str, ...]] = {
    "Frame.attached_to": ("tip",),
    "Joint.parent": ("base",),
    "Joint.type": ("prismatic", "revolute"),
    "Light.type": ("spot",),
    "Mimic.axis": ("axis2",),
    "Mimic.joint": ("slide",),
    "Model.canonical_link": ("thigh",),
    "Sensor.type": ("magnetometer",),
}
"""Other words for fields that take only some; all others get a made-up one."""
_NAMED_ELSEWHERE = frozenset({"Joint.child", "Link.name", "Model.links"})
"""Fields of which no change alone makes a valid document."""
_DEFAULTS = frozenset({("Joint.axis", "spindle")})
"""What can be left out, because it says what is so without it."""


class Change(NamedTuple):
    """Another value for a field of a node."""

    node: Node
    field: str
    value: object

    @property
    def changed(self) -> Node:
        return self.node.copy(**{self.field: self.value})

    def in_document(self) -> Document:
        changed = self.changed
        return rewrite(_document(), type(self.node), lambda each: changed if each is self.node else each)

    @property
    def is_said(self) -> bool:
        """Whether MJCF says the field of the node, both as it was and as it is."""
        return all(self.field in (self._said(each) or ()) for each in (self.node, self.changed))

    def _said(self, node: Node) -> frozenset[str] | None:
        return said_of_limit(node, _joint_of(self.node)) if isinstance(node, Limit) else said_by_mjcf(node)


class Written(NamedTuple):
    """What becomes of a document: MJCF without its carriers, the carriers, and the ledger."""

    mjcf: str
    carriers: list[str]
    ledger: list[str]

    @classmethod
    def of(cls, document: Document) -> "Written | None":
        """Convert a document; None where it is no valid one."""
        try:
            made = twinform.convert(document, to="mjcf")
        except twinform.CompileError:
            return None
        text, ledger = made.text, [f"{each.fate} {each.message}" for each in made.ledger.entries]
        return cls(_CARRIER.sub("", text), _CARRIER.findall(text), ledger)


@cache
def _document() -> Document:
    return twinform.load(_FILE)


@cache
def _written() -> Written:
    written = Written.of(_document())
    assert written is not None
    return written


def _joint_of(limit: Node) -> Joint:
    joints = (each for each in walk(_document()) if isinstance(each, Joint))
    return next(each for each in joints for axis in (each.axis, each.axis2) if axis and axis.limit is limit)


def _others(kind: str, value: object) -> Iterator[object]:
    """Yield other values for a field."""
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield value + 1
    elif isinstance(value, float):
        yield value * 1.0625 + 0.03125
    elif isinstance(value, str):
        yield from _WORDS.get(kind, (f"{value}_too",))
    elif isinstance(value, Node):
        yield None
    elif are_nodes(value):
        yield value[:-1]
    elif isinstance(value, tuple) and value:
        yield tuple(reversed(value))  # pyright: ignore[reportUnknownArgumentType] - numbers


def _changes() -> Mapping[str, list[Change]]:
    """Return the changes of each field that is written somewhere in the document."""
    found: defaultdict[str, list[Change]] = defaultdict(list)
    for node in walk(_document()):
        if isinstance(node, Document):
            continue
        for name in fields_of(type(node)).keys() - _APART:
            kind, value = f"{type(node).__name__}.{name}", getattr(node, name)
            found[kind] += [Change(node, name, other) for other in _others(kind, value) if other != value]
    return {kind: changes for kind, changes in found.items() if changes}


CHANGES = _changes()


@pytest.mark.parametrize("kind", sorted(CHANGES.keys() - _NAMED_ELSEWHERE))
def test_a_changed_field_is_written_or_carried(kind: str) -> None:
    tried = 0
    for change in CHANGES[kind]:
        after = Written.of(change.in_document())
        if after is None or (kind, getattr(change.node, "name", None)) in _DEFAULTS:
            continue
        assert after != _written(), "neither MJCF nor its carriers nor the ledger say this field"
        if change.is_said and change.field not in IDENTITY:
            assert after.mjcf != _written().mjcf, "MJCF is said to say this field, and does not"
        tried += 1
        if tried == _MOST:
            break
    assert tried


def test_every_class_that_mjcf_says_something_of_is_changed() -> None:
    written = {type(each) for each in walk(_document()) if said_by_mjcf(each)}
    assert {kind.partition(".")[0] for kind in CHANGES} >= {each.__name__ for each in written} - {"Document"}
