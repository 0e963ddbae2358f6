"""Documents: whole files in one of the formats, and the worlds in them."""

from enum import StrEnum
from typing import assert_never

from twinform.ir.element import Namespace
from twinform.ir.joint import Joint
from twinform.ir.model import Include, Model
from twinform.ir.node import Node, Vector3
from twinform.ir.pose import Frame
from twinform.ir.record import record
from twinform.ir.sensor import Light, Plugin
from twinform.notebooks import draw


@record
class World(Node):
    """Models, lights and frames in one frame. Physics, scene and the like stay in `opaque`.

    Attributes:
        name: unique in its file.
        gravity: the acceleration in the frame of the world; m/s^2.
        models: in their order.
        includes: models of other files.
        lights: in their order.
        frames: the named frames.
        joints: between models, or of one to the world.
        plugins: the systems that a simulator runs.
    """

    name: str
    gravity: Vector3 | None = None
    models: tuple[Model, ...] = ()
    includes: tuple[Include, ...] = ()
    lights: tuple[Light, ...] = ()
    frames: tuple[Frame, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[Plugin, ...] = ()


class Format(StrEnum):
    """The three languages."""

    URDF = "urdf"
    SDF = "sdf"
    MJCF = "mjcf"

    @property
    def counterpart(self) -> "Format":
        """The format that a file of this one is converted to where none is asked for."""
        match self:
            case Format.SDF:
                return Format.URDF
            case Format.URDF | Format.MJCF:
                return Format.SDF
            case _:
                assert_never(self)


@record
class Document(Node):
    """All that one file holds, in the terms of `format`.

    Attributes:
        format: the language in whose terms it is: what is read of MJCF is in the terms of SDF, so that only a document
            which is about to be written is of MJCF.
        version: that of the language, as the file writes it; `None` where it has none.
        namespaces: the prefixes that it declares and what they stand for, in their order.
        worlds: of SDF.
        models: exactly one in URDF, which is the robot; in SDF those beside the worlds.
        lights: of SDF, beside the worlds.
        includes: of SDF, beside the worlds.
    """

    format: Format
    version: str | None = None
    namespaces: tuple[Namespace, ...] = ()
    worlds: tuple[World, ...] = ()
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    includes: tuple[Include, ...] = ()

    def _repr_html_(self) -> str:
        """What a notebook shows of it."""
        return draw("Document", self)
