"""Names of links, joints and frames: those of bodies, joints and sites, where SDF can hold them, or made ones.

In MJCF each kind of part has its own names, and parts may have none. In SDF links, joints and frames of a model share
their names. A changed name stands in `<tf:name>`, a made one in `<tf:made-name>`.
"""

from collections.abc import Collection
from typing import TypeVar

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Node, Opaque
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import MADE_NAME, annotation, with_annotation
from twinform.passes.carriers.old_names import old_name
from twinform.passes.legalise.to_mjcf.writing_context import safe_name
from twinform.passes.shared.nodes import reserve_name

AnyNode = TypeVar("AnyNode", bound=Node)


class NameScope:
    """The names of one model; parts that come first keep theirs.

    No made name is one of those that are written anywhere in the file: the rest of the file refers to parts by these.
    """

    def __init__(self, written: Collection[str] = ()) -> None:
        self._written = written
        self._taken = {WORLD}
        self._numbers: dict[str, int] = {}
        self._given: dict[Piece, str] = {}

    def give(self, piece: Piece, unnamed: str, kind: str) -> str:
        """Name an element: as it is called, with its kind behind that where another part is called so, or `unnamed`."""
        wish = safe_name(piece.take("name") or unnamed)
        is_others = wish in self._taken or (piece.name is None and wish in self._written)
        self._given[piece] = self.make(f"{wish}_{kind}") if is_others else self._reserve(wish)
        return self._given[piece]

    def of(self, piece: Piece) -> str:
        """Return the name that an element was given."""
        return self._given[piece]

    def make(self, wish: str) -> str:
        """Return a new name for a part that no element stands for."""
        made = self._reserve(wish)
        while made in self._written:
            made = self._reserve(wish)
        return made

    def _reserve(self, wish: str) -> str:
        return reserve_name(wish, self._taken, self._numbers)

    def marked(self, node: AnyNode, piece: Piece) -> AnyNode:
        """Return the node of an element with an annotation of the name that it has in MJCF, if that is another one."""
        given = self._given[piece]
        if piece.name is None:
            return with_annotation(node, MADE_NAME, given)
        if given == piece.name:
            return node
        return node.copy(opaque=(old_name(piece.name, given), *node.opaque))


def name_mark(name: str | None, given: str) -> tuple[Opaque, ...]:
    """Return the annotation of a name that MJCF does not have, or has otherwise."""
    if name is None:
        return (annotation(MADE_NAME, given),)
    return () if name == given else (old_name(name, given),)
