"""What a xacro file expands to, and where each element of it was written."""

from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import LineOrigins, Location


class MacroCall(NamedTuple):
    """A call of a macro: its file, the number of its element there, and that of the call around it, or 0."""

    file: str
    number: int
    around: int


class PartOrigin(NamedTuple):
    """Where an element was written: its file and line, its number there, and that of the call that made it, or 0."""

    file: str
    line: int
    number: int
    call: int


@dataclass(frozen=True, slots=True)
class Expansion:
    """The expanded text, and where the elements on its lines were written.

    `strays` are the places of texts that stand in another file than the element around them, and `texts` all files
    that were read, by their names. `parts` are the origins of all elements in their order, and `calls` those of the
    macros; elements are numbered from 0 in each file, and calls from 1.
    """

    text: bytes
    origins: LineOrigins
    strays: Mapping[str, Location]
    texts: Mapping[str, bytes]
    parts: Sequence[PartOrigin | None] = field(default=(), repr=False)
    calls: Sequence[MacroCall] = field(default=(), repr=False)
