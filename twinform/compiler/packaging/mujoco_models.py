"""Builds a folder for MuJoCo: the robot as MJCF, its meshes and textures, and a scene in which it stands.

    model.xml   scene.xml   assets/base.obj   assets/wood.png

`model.xml` is the robot alone, to be included or attached elsewhere. `scene.xml` includes it, and adds a ground and a
light unless it has them. All paths lead from the folder, so that it loads wherever it lies.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import count
from pathlib import PurePosixPath
from typing import ClassVar

from lxml import etree

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package, PackageLayout, safe_name
from twinform.diagnostics import DiagnosticSink, Location, SideFile
from twinform.ir import Document
from twinform.passes import Pipeline
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.mesh_jobs.child_process import do
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError, content_of
from twinform.passes.meshes.convert_meshes import ConvertMeshes
from twinform.passes.shared.document_uris import Kind, map_uris
from twinform.schemas import XmlElement

MODEL, SCENE, ASSETS = "model.xml", "scene.xml", "assets"
_LAYOUT = PackageLayout({}, ASSETS, ASSETS, ASSETS, ASSETS)
"""Files are named by their paths: MuJoCo knows no packages."""


def build(order: Order, collection: Collection) -> Built:
    """Build the folder of a robot, or of a world.

    Raises:
        CompileError: the model or a file of it has an error.
    """
    own = Collection(_LAYOUT, collection.lenient, companions=False)  # MuJoCo takes no colors from a mesh
    for name in (MODEL, SCENE):
        own.reserve(name)
    made = _with_passes(order).convert(own, "mjcf")
    files: dict[str, Content] = {**own.files, MODEL: made.text.encode()}
    files[SCENE] = scene_text(made.text, order.name).encode()
    return Built(Package(order.name, files), made.diagnostics, {MODEL: made.ledger})


def _with_passes(order: Order) -> Order:
    """Return the order with the passes that write meshes and images in formats of MuJoCo."""
    # Colors come from the material of a geom, and not from the file of its mesh.
    meshes = ConvertMeshes.model_validate({"for": "mujoco", "folder": ASSETS, "drop_appearance": True})
    passes = Pipeline((*order.conversion.passes, meshes, ImagesAsPng.unchecked(folder=ASSETS)))
    return replace(order, conversion=replace(order.conversion, passes=passes))


_GRAY, _BLUE, _WHITE = "0.4 0.4 0.42", "0.35 0.5 0.65", "1 1 1"


def scene_text(model: str, name: str) -> str:
    """Write a scene that includes the model, with a ground and a light unless the model has them."""
    root = etree.fromstring(model.encode())
    scene = etree.Element("mujoco", model=f"{name} scene")
    etree.SubElement(scene, "include", file=MODEL)
    body = etree.Element("worldbody")
    if root.find(".//light") is None:
        etree.SubElement(body, "light", pos="0 0 4", dir="0 0 -1", type="directional", diffuse="0.7 0.7 0.7")
    if not any(each.get("type") == "plane" for each in root.iter("geom")):
        ground = _free_name(root, "ground")
        scene.append(_looks(ground))
        etree.SubElement(body, "geom", name=ground, type="plane", size="0 0 0.05", material=ground)
    if len(body):
        scene.append(body)
    etree.indent(scene)
    return f'<?xml version="1.0"?>\n{etree.tostring(scene, encoding="unicode")}\n'


def _looks(ground: str) -> XmlElement:
    """Make the sky, and the checks of the ground, whose texture and material are called like it."""
    assets = etree.Element("asset")
    etree.SubElement(assets, "texture", type="skybox", builtin="gradient", rgb1=_BLUE, rgb2=_WHITE, width="256",
                     height="256")  # fmt: skip
    etree.SubElement(assets, "texture", name=ground, type="2d", builtin="checker", rgb1=_GRAY, rgb2=_WHITE,
                     width="256", height="256")  # fmt: skip
    etree.SubElement(assets, "material", name=ground, texture=ground, texuniform="true", texrepeat="1 1")
    return assets


def _free_name(root: XmlElement, wanted: str) -> str:
    """Return a name that no part of a model has."""
    taken = {each.get("name") for each in root.iter("*")}
    return next(name for name in _numbered(wanted) if name not in taken)


def _numbered(name: str) -> Iterator[str]:
    yield name
    yield from (f"{name}_{number}" for number in count(2))


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
