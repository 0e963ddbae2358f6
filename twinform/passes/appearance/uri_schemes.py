"""Conversion of file references between schemes: `package://`, `model://`, `file://` and paths."""

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from posixpath import normpath
from typing import Literal, Self
from urllib.parse import unquote

from twinform.passes.framework.assets import Assets
from twinform.passes.transforms.uri_schemes import FUEL_SERVERS

Scheme = Literal["package", "model", "file", "relative", "fuel"]
Known = Literal["package", "model", "file", "relative", "http", "fuel"]

_SCHEME = re.compile(r"([A-Za-z][\w+.-]*):")
_SCHEMES: dict[str, Known] = {"package": "package", "model": "model", "file": "file", "http": "http", "https": "http"}


class UnmappedError(Exception):
    """Why a URI cannot be written in another scheme."""

    def __init__(self, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.help = help


def scheme_of(uri: str) -> Known | None:
    """How a file is named; None for plain names and for schemes that are not known."""
    uri = uri.strip()
    found = _SCHEME.match(uri)
    if found:
        scheme = _SCHEMES.get(found[1].lower())
        server = uri.partition("://")[2].partition("/")[0].lower()
        return "fuel" if scheme == "http" and server in FUEL_SERVERS else scheme
    if not uri or uri.startswith("__"):
        return None
    return "file" if uri.startswith("/") else "relative"


@dataclass(frozen=True, slots=True)
class Roots:
    """The folders of packages and models that are named, and all others."""

    named: tuple[tuple[str, Path], ...]
    assets: Assets

    @classmethod
    def of(cls, words: tuple[str, ...], assets: Assets) -> Self:
        """From texts such as `arm=/models/arm`."""
        pairs = (word.partition("=") for word in words)
        return cls(tuple((name, Path(folder)) for name, _, folder in pairs), assets)

    def find(self, uri: str) -> Path:
        """The file of a URI.

        Raises:
            AssetError: it is not there.
        """
        scheme, _, rest = uri.partition("://")
        name, _, inner = normpath(unquote(rest)).partition("/")
        for known, folder in self.named if scheme in {"package", "model"} else ():
            if known == name and ".." not in inner.split("/"):
                return folder / inner
        return self.assets.find(uri)

    def holder(self, file: Path, kind: Literal["package", "model"]) -> tuple[str, str]:
        """The name of the package or model that a file lies in, and the path in it.

        Raises:
            UnmappedError: it lies in none.
        """
        for name, folder in (*self._named(), *self._around(file, kind)):
            if file.is_relative_to(folder):
                return name, file.relative_to(folder).as_posix()
        manifest = "package.xml" if kind == "package" else "model.config"
        raise UnmappedError(f"no folder around {str(file)!r} has a {manifest}", "name it: roots=[NAME=FOLDER]")

    def _named(self) -> Iterator[tuple[str, Path]]:
        return ((name, _absolute(folder)) for name, folder in self.named)

    def _around(self, file: Path, kind: Literal["package", "model"]) -> Iterator[tuple[str, Path]]:
        for folder in (file, *file.parents):
            name = self.assets.holder(folder, kind)
            if name is not None:
                yield name, folder


def rewritten(uri: str, scheme: Known, to: Scheme, roots: Roots) -> str:
    """A URI of a scheme in another one.

    Raises:
        UnmappedError: there is no such URI for the file.
        AssetError: the file is not found.
    """
    if scheme in {"package", "model"} and to in {"package", "model"}:
        return f"{to}://{uri.partition('://')[2]}"
    file = _absolute(roots.find(uri))
    if to == "file":
        return file.as_uri()
    if to == "relative":
        folder = roots.assets.folder
        if folder is None:
            raise UnmappedError("the document lies in no folder")
        return Path(os.path.relpath(file, _absolute(folder))).as_posix()
    if to == "fuel":
        address = roots.assets.address(file)
        if address is None:
            raise UnmappedError(f"{str(file)!r} is in no local cache of Fuel", "put it there with `twinform fuel add`")
        return address
    name, inner = roots.holder(file, to)
    return f"{to}://{name}" if inner == "." else f"{to}://{name}/{inner}"


def _absolute(path: Path) -> Path:
    """From the root of the file system, as the file was named: links are not followed."""
    return Path(os.path.normpath(path.absolute()))
