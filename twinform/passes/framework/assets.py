"""Access to files beside a model: an interface for passes, which the compiler implements."""

from pathlib import Path
from typing import Literal, Protocol

from twinform.diagnostics import Rule, rules
from twinform.file_access import Readable


class FindingError(Exception):
    """What is not possible, and the rule, message and help of the finding that says so."""

    def __init__(self, rule: Rule, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.rule = rule
        self.message = message
        self.help = help


class AssetError(FindingError):
    """A URI leads to no file that may be read."""


# Passes must not import the compiler, which resolves URIs. An argument of `run` would burden every
# pass for the sake of a few, and a path among the options would tie a pipeline to a machine. The
# assets that a pass is bound to take no part in the text of a pipeline.
class Assets(Protocol):
    """Finds the files that a document names."""

    @property
    def folder(self) -> Path | None:
        """The folder of the document; None for a text that was not read from a file."""
        ...

    @property
    def readable(self) -> Readable:
        """The files that may be read because the document names them."""
        ...

    def find(self, uri: str) -> Path:
        """The file or folder that a URI names.

        Raises:
            AssetError: there is none, or it must not be read.
        """
        ...

    def xml(self, path: Path, largest: int) -> bytes:
        """The text of an XML file that was found, of up to `largest` bytes; one of xacro is expanded.

        Raises:
            AssetError: it cannot be read or expanded, or must not be.
        """
        ...

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        """The name of the ROS package or Gazebo model in a folder; None where the folder holds neither."""
        ...

    def address(self, file: Path) -> str | None:
        """The address on Fuel of a file or folder in the local cache; None for all others."""
        ...


class _NoAssets:
    """The assets of a document whose origin is unknown: there are none."""

    folder: Path | None = None
    readable = Readable()

    def find(self, uri: str) -> Path:
        raise AssetError(rules.UNRESOLVED_URI, f"{uri!r} cannot be looked up: only the text of the model is known")

    def xml(self, path: Path, largest: int) -> bytes:
        del largest
        raise AssetError(rules.UNREADABLE_FILE, f"{path.name!r} cannot be read: only the text of the model is known")

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        del folder, kind
        return None

    def address(self, file: Path) -> str | None:
        del file
        return None


NO_ASSETS: Assets = _NoAssets()
