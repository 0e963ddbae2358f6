"""Asset access: an interface for passes that read files beside a model, implemented by the compiler."""

from pathlib import Path
from typing import Literal, Protocol

from twinform.diagnostics import Rule, rules
from twinform.file_access import Readable


class AssetError(Exception):
    """Why a URI leads to no file that may be read, as a diagnostic would say it."""

    def __init__(self, rule: Rule, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.rule = rule
        self.message = message
        self.help = help


# Passes must not import the compiler, which knows where URIs lead. An argument of `run` would
# concern every pass for the sake of a few, a path among the options would make pipelines depend on
# the machine, and a global would be one. The binding takes no part in the text of a pipeline.
class Assets(Protocol):
    """Where the files are that a document names."""

    @property
    def folder(self) -> Path | None:
        """The folder of the document; None for a text that came from no file."""
        ...

    @property
    def readable(self) -> Readable:
        """The files that may be read because the document leads to them."""
        ...

    def find(self, uri: str) -> Path:
        """The file or folder that a URI names.

        Raises:
            AssetError: there is none, or it must not be read.
        """
        ...

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        """What the package of ROS or the model of Gazebo is called that a folder is; None where it is none."""
        ...

    def address(self, file: Path) -> str | None:
        """The address on Fuel of a file or folder in its local cache; None for all others."""
        ...


class _NoAssets:
    """A document by itself, of which the origin is not known."""

    folder: Path | None = None
    readable = Readable()

    def find(self, uri: str) -> Path:
        raise AssetError(rules.UNRESOLVED_URI, f"{uri!r} cannot be looked up: only the text of the model is known")

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        del folder, kind
        return None

    def address(self, file: Path) -> str | None:
        del file
        return None


NO_ASSETS: Assets = _NoAssets()
