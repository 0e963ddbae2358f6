"""`Document`: a whole file, URDF or SDF."""

from enum import StrEnum

from twinform.ir.light import Light
from twinform.ir.model import Include, Model
from twinform.ir.node import Node
from twinform.ir.record import record
from twinform.ir.world import World
from twinform.notebooks import draw


class Format(StrEnum):
    """The two languages."""

    URDF = "urdf"
    SDF = "sdf"


@record
class Document(Node):
    """All that one file holds, in the terms of `format`.

    Attributes:
        format: the language of the file.
        version: that of the language, as the file writes it; `None` where it has none.
        namespaces: the prefixes that it declares and what they stand for, in their order.
        worlds: of SDF.
        models: exactly one in URDF, which is the robot; in SDF those beside the worlds.
        lights: of SDF, beside the worlds.
        includes: of SDF, beside the worlds.
    """

    format: Format
    version: str | None = None
    namespaces: tuple[tuple[str, str], ...] = ()
    worlds: tuple[World, ...] = ()
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    includes: tuple[Include, ...] = ()

    def _repr_html_(self) -> str:
        """What a notebook shows of it."""
        return draw("Document", self)
