"""Readers of children that are remarkable by their row alone: the same readers, with a word about the element first."""

from collections.abc import Callable

from twinform.schemas import messages
from twinform.schemas.facts import Fact, Version
from twinform.schemas.messages import Context
from twinform.schemas.stores import Data
from twinform.schemas.xml import XmlElement

ReadChild = Callable[[XmlElement, Data, str, int, Context], None]
"""Reads a child: (child, node, path from the node to the parent, place among its like, context)"""


def remarked(row: Fact, version: Version, read: ReadChild) -> ReadChild:
    """The reader of a child in a version, with what there is to say about every such child."""
    if row.deprecated and row.exists_in(version):
        return _after(messages.deprecated, read)
    if row.dialect:
        dialect = row.dialect
        return _after(lambda context, child: messages.dialect_element(context, child, dialect), _aside(read))
    if row.aside:
        return _aside(read)
    if row.exists_in(version):
        return read
    return _after(lambda context, child: messages.outside_version(context, child, row), read)


def _after(say: Callable[[Context, XmlElement], None], read: ReadChild) -> ReadChild:
    """The same reader, after a word about the child."""

    def read_after(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
        say(context, child)
        read(child, node, at, place, context)

    return read_after


def _aside(read: ReadChild) -> ReadChild:
    """The same reader for an element that is no business of those who read the robot: its faults are theirs alone."""

    def read_aside(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
        before, context.aside = context.aside, True
        read(child, node, at, place, context)
        context.aside = before

    return read_aside
