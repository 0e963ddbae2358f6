"""`Document`: a whole file, URDF or SDF."""

from enum import StrEnum

from twinform.ir.light import Light
from twinform.ir.model import Include, Model
from twinform.ir.node import Node
from twinform.ir.world import World


class Format(StrEnum):
    """The two languages."""

    URDF = "urdf"
    SDF = "sdf"


class Document(Node):
    """All that one file holds, in the terms of `format`.

    `version` is that of the file; `None` where it has none. `namespaces` are the prefixes that it declares.
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
        from twinform.report.notebook import document_html  # noqa: PLC0415 - see the contracts in pyproject.toml

        return document_html(self)
