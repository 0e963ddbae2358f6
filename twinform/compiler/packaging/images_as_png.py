"""The pass that writes the textures of a model as PNG, which is all that MuJoCo reads."""

from pathlib import PurePosixPath
from typing import ClassVar

from twinform.compiler.packaging.package import safe_name
from twinform.diagnostics import DiagnosticSink, Location, SideFile
from twinform.ir import Document
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.mesh_jobs.child_process import do
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError, content_of
from twinform.passes.shared.document_uris import Kind, map_uris

_READ = frozenset({".bmp", ".gif", ".jpeg", ".jpg", ".tga", ".tif", ".tiff", ".webp"})
"""The endings of images that are written as PNG."""


class ImagesAsPng(AssetPass):
    """Write textures in other formats as PNG files beside the result.

    Changes: the URIs of images of other formats.
    Never touches: images that cannot be read, which the writer of the target reports.
    Diagnostics: none.
    """

    name: ClassVar[str] = "images-as-png"

    folder: str = "."

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Return the document with the names of the new files."""

        def change(uri: str, kind: Kind, _where: Location) -> str:
            if kind != "texture" or PurePosixPath(uri.strip()).suffix.lower() not in _READ:
                return uri
            if uri not in made:
                made[uri] = self._write(uri, sink) or uri
            return made[uri]

        made: dict[str, str] = {}
        return map_uris(document, change)

    def _write(self, uri: str, sink: DiagnosticSink) -> str | None:
        """Write one image; None where it cannot be read."""
        try:
            path = self._assets.find(uri.strip())
            content = content_of(path)
        except (AssetError, RefusedMeshError, OSError):
            return None
        result = do(MeshJob("image", {}, path.suffix.lower().removeprefix("."), content))
        data = result.files.get(".png")
        if data is None:
            return None
        taken = {each.path.casefold() for each in sink.side_files}
        name = self._free_name(safe_name(path.stem), taken)
        sink.side_files.append(SideFile(name, data))
        return name

    def _free_name(self, stem: str, taken: set[str]) -> str:
        name, number = f"{self.folder}/{stem}.png", 1
        while name.casefold() in taken:
            number += 1
            name = f"{self.folder}/{stem}_{number}.png"
        return name
