"""Rewrite URIs of files to another scheme: `package://`, `model://`, `file://`, Fuel, or relative paths."""

import os
from collections.abc import Iterator
from pathlib import Path
from posixpath import normpath
from typing import ClassVar, Literal, Self
from urllib.parse import unquote

from pydantic import Field, field_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import UNMAPPED_URI
from twinform.ir import Document
from twinform.lazy import lazy_pattern
from twinform.passes.framework.assets import AssetError, Assets
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.shared.document_uris import FUEL_SERVERS, Kind, map_uris

Scheme = Literal["package", "model", "file", "relative", "fuel"]
KnownScheme = Literal["package", "model", "file", "relative", "http", "fuel"]
_SCHEME = lazy_pattern(r"([A-Za-z][\w+.-]*):")
_SCHEMES: dict[str, KnownScheme] = {
    "package": "package",
    "model": "model",
    "file": "file",
    "http": "http",
    "https": "http",
}


class RewriteUris(AssetPass):
    """Say URIs of meshes, textures and includes in the scheme `to`.

    Changes URIs whose scheme is one of `from-schemes`, of files that are among `kinds`:

    1. `package://` and `model://` become each other, whether or not their files are there;
    2. to `file` and `relative`, they are looked up, in `roots` first, then as `--path` and the variables of ROS and
       Gazebo say; a relative path is relative to the folder of the document;
    3. to `package` and `model`, files and paths are relative to the folder around them that is in `roots`, has a
       package.xml, or a model.config;
    4. to `fuel`, those of the local cache of Fuel get the address that they have on its server.

    Never touches: URIs that are in the scheme already, names such as `__default__`, and the parameters of plugins.
    Diagnostics: `unmapped-uri` for each URI that cannot be written so; it stays.
    """

    name = "rewrite-uris"
    example: ClassVar[str] = "rewrite-uris{to=model kinds=[mesh,texture]}"

    to: Scheme = Field(description="The scheme in which URIs are written.")
    from_schemes: frozenset[Literal["package", "model", "file", "relative", "http", "fuel"]] = Field(
        default=frozenset({"package", "model", "file", "relative", "http"}),
        description="Which URIs are rewritten; a path that begins with `/` counts as a file, `https` and Fuel as http; "
        "`fuel` means addresses of Fuel alone.",
    )
    kinds: frozenset[Kind] = Field(
        default=frozenset({"mesh", "texture", "include"}),
        description="URIs of what; material scripts and terrains count as textures.",
    )
    roots: tuple[str, ...] = Field(
        default=(), description="Folders of packages or models, as NAME=FOLDER; looked at before all others."
    )

    @field_validator("roots")
    @classmethod
    def _check_roots(cls, roots: tuple[str, ...]) -> tuple[str, ...]:
        for root in roots:
            name, separator, folder = root.partition("=")
            if not name or not separator or not folder or "/" in name:
                raise ValueError(f"{root!r} is not NAME=FOLDER")
        return roots

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other URIs."""
        roots = Roots.of(self.roots, self._assets)

        def change(uri: str, kind: Kind, where: Location) -> str:
            scheme = scheme_of(uri)
            if kind not in self.kinds or scheme is None or scheme == self.to or not self._takes(scheme):
                return uri
            try:
                return rewrite_uri(uri.strip(), scheme, self.to, roots)
            except UnmappedError as error:
                sink.report(UNMAPPED_URI, f"{uri.strip()!r} stays: {error}", where, found=uri.strip(), help=error.help)
            except AssetError as error:
                sink.report(UNMAPPED_URI, f"{error.message}, so it is kept", where, found=uri.strip(), help=error.help)
            return uri

        return map_uris(document, change)

    def _takes(self, scheme: KnownScheme) -> bool:
        """Whether URIs of a scheme are rewritten."""
        return scheme in self.from_schemes or (scheme == "fuel" and "http" in self.from_schemes)


class UnmappedError(Exception):
    """Why a URI cannot be written in another scheme."""

    def __init__(self, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.help = help


def scheme_of(uri: str) -> KnownScheme | None:
    """The scheme of a URI or path; None for plain names and unknown schemes."""
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
    """The folders of packages and models that the user named, and all others."""

    named: tuple[tuple[str, Path], ...]
    assets: Assets

    @classmethod
    def of(cls, words: tuple[str, ...], assets: Assets) -> Self:
        """The roots in texts such as `arm=/models/arm`."""
        pairs = (word.partition("=") for word in words)
        return cls(tuple((name, Path(folder)) for name, _, folder in pairs), assets)

    def find(self, uri: str) -> Path:
        """The file of a URI.

        Raises:
            AssetError: the file is not there.
        """
        scheme, _, rest = uri.partition("://")
        name, _, inner = normpath(unquote(rest)).partition("/")
        for known, folder in self.named if scheme in {"package", "model"} else ():
            if known == name and ".." not in inner.split("/"):
                return folder / inner
        return self.assets.find(uri)

    def holder(self, file: Path, kind: Literal["package", "model"]) -> tuple[str, str]:
        """The name of the package or model around a file, and the path in it.

        Raises:
            UnmappedError: the file is in no package or model.
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


def rewrite_uri(uri: str, scheme: KnownScheme, to: Scheme, roots: Roots) -> str:
    """A URI of one scheme in another scheme.

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
    """An absolute path without following links."""
    return Path(os.path.normpath(path.absolute()))
