"""Rewrite URIs of files to another scheme."""

from typing import ClassVar, Literal

from pydantic import Field, field_validator

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import UNMAPPED_URI
from twinform.ir import Document
from twinform.passes.appearance.uri_schemes import Known, Roots, Scheme, UnmappedError, rewritten, scheme_of
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.transforms.document_uris import Kind, map_uris


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
                return rewritten(uri.strip(), scheme, self.to, roots)
            except UnmappedError as error:
                sink.report(UNMAPPED_URI, f"{uri.strip()!r} stays: {error}", where, found=uri.strip(), help=error.help)
            except AssetError as error:
                sink.report(UNMAPPED_URI, f"{error.message}, so it is kept", where, found=uri.strip(), help=error.help)
            return uri

        return map_uris(document, change)

    def _takes(self, scheme: Known) -> bool:
        """Whether URIs of a scheme are rewritten."""
        return scheme in self.from_schemes or (scheme == "fuel" and "http" in self.from_schemes)
