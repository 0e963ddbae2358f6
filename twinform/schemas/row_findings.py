"""Diagnostics that the facts row of an element calls for: deprecated, of another version, of a dialect."""

from collections.abc import Callable

from twinform.schemas import messages
from twinform.schemas.facts import Fact, Version
from twinform.schemas.messages import Context
from twinform.schemas.node_makers import Data
from twinform.schemas.untyped_parts import keep_element
from twinform.schemas.xml import XmlElement, is_blank

ReadChild = Callable[[XmlElement, Data, Context, int], None]
"""Reads a child: (child, values of the node around it, context, place among its like)"""


def with_row_findings(
    row: Fact, version: Version, read: ReadChild, at: str, *, has_text: bool, keep: bool
) -> ReadChild:
    """The reader of a child in a version, with the diagnostics of every such child.

    `at` is the path from the node to the element around it, `has_text` whether its element has text by the facts, and
    `keep` whether what has no field is kept.
    """
    if row.deprecated and row.exists_in(version):
        return _after(messages.deprecated, read)
    if row.dialect:
        dialect = row.dialect
        return _after(lambda context, child: messages.dialect_element(context, child, dialect), _aside(read))
    if row.aside:
        return _aside(read)
    if row.exists_in(version):
        return read
    read_other = _after(lambda context, child: messages.outside_version(context, child, row), read)
    return read_other if has_text or row.place else _unless_another(read_other, at, keep=keep)


def _unless_another(read: ReadChild, at: str, *, keep: bool) -> ReadChild:
    """Wrap a reader: an element with text that only shares its name with another version's is unknown."""

    def read_or_keep(child: XmlElement, node: Data, context: Context, place: int) -> None:
        if len(child) or is_blank(child.text or ""):
            read(child, node, context, place)
            return
        messages.unknown_element(context, child, ())
        if keep:
            keep_element(child, node, at, context)

    return read_or_keep


def _after(say: Callable[[Context, XmlElement], None], read: ReadChild) -> ReadChild:
    """Wrap a reader: report something about the child before it is read."""

    def read_after(child: XmlElement, node: Data, context: Context, place: int) -> None:
        say(context, child)
        read(child, node, context, place)

    return read_after


def _aside(read: ReadChild) -> ReadChild:
    """Wrap a reader for an element outside of the robot's description, whose faults are warnings."""

    def read_aside(child: XmlElement, node: Data, context: Context, place: int) -> None:
        before, context.aside = context.aside, True
        read(child, node, context, place)
        context.aside = before

    return read_aside
