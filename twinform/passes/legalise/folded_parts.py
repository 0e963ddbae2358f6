"""Links and joints with their `<gazebo>` folded in, kept while one file is read and converted.

Reading folds them to report what is wrong, and legalisation folds the same objects again.
"""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple

from twinform.diagnostics import DiagnosticSink
from twinform.ir import GazeboExtension, Node, Opaque


class FoldedPart(NamedTuple):
    """A part, what was found and carried on the way, and what it was made of."""

    part: Node
    sink: DiagnosticSink
    kept: list[Opaque]
    made_of: tuple[Node, list[GazeboExtension]]


_KNOWN: ContextVar[dict[tuple[object, ...], FoldedPart] | None] = ContextVar("folded_parts", default=None)


@contextmanager
def each_folded_once() -> Generator[None]:
    """Keep the parts that are folded inside."""
    token = _KNOWN.set({})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def folded_part(
    node: Node, extensions: list[GazeboExtension], context: tuple[object, ...], fold: Callable[[], FoldedPart]
) -> FoldedPart | None:
    """The part that `fold` makes of a node, or made before of these objects in an equal context; None if none is kept.

    Nodes are frozen, so that a pass which edits one makes another object of it.
    """
    known = _KNOWN.get()
    if known is None:
        return None
    # The objects are kept with the result, so that no other one can have their address.
    key: tuple[Any, ...] = (context, id(node), *map(id, extensions))
    if key not in known:
        known[key] = fold()
    return known[key]
