"""Write the meshes of a model in a format that a program reads."""

import tomllib
from functools import cache
from pathlib import PurePosixPath
from typing import ClassVar, Literal, NamedTuple, Self, cast

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import CHANGED_MESH, KEPT_MESH
from twinform.ir import Collision, Document, Geometry, Link, Mesh, Visual, rewrite
from twinform.package_files import package_files
from twinform.passes.framework.pass_base import EVERY, matches, with_such_a_name
from twinform.passes.mesh_jobs.mesh_files import MeshFormat, kind_of
from twinform.passes.meshes.mesh_pass import MeshPass, Workbench, report_kept_mesh, without_submesh
from twinform.passes.meshes.mesh_source import MeshSource
from twinform.passes.shared.mesh_solids import MeshError

ConsumerName = Literal["gazebo", "gazebo-fortress", "rviz", "mujoco", "pybullet", "drake", "pinocchio", "web"]
Shapes = Literal["visual", "collision", "all"]
AnyShape = Visual | Collision


class ConvertMeshes(MeshPass):
    """Write the meshes of shapes in another format, with the same surface in meters.

    Changes the shapes of `shapes` on links whose name matches `links`, whose mesh is in a format that is not:

    1. with `to`, this one;
    2. with `for`, one that this program reads; it is then written in the one that it reads best. So are STL files of
       text, or with too many triangles, for MuJoCo.

    A COLLADA file names its unit, and the new file has meters. Which of its axes is up it says too, and neither Gazebo
    nor RViz nor PyBullet turns it: it stays as it is. In a glTF file it depends on the reader, see `gltf-up`.
    Materials, textures and the coordinates of these go along to OBJ and glTF; STL has none.
    (`pip install 'twinform[meshes]'`)

    Never touches: poses, scales and masses. A shape stays where a file that its mesh names is missing, or where colors
    would be lost: give `drop-appearance=true` if they may be.
    Diagnostics: `changed-mesh` for each file, `kept-mesh`, `unreadable-mesh`, and `mesh-reader-missing`.
    """

    name = "convert-meshes"
    example: ClassVar[str] = "convert-meshes{for=mujoco}"

    to: MeshFormat | None = Field(default=None, description="The format to write; `obj`, binary `stl` or binary `glb`.")
    consumer: ConsumerName | None = Field(default=None, alias="for", description="The program that is to read them.")
    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    shapes: Shapes = Field(default="all", description="Meshes of which shapes.")
    drop_appearance: bool = Field(default=False, description="Whether colors may be lost, as in STL.")

    @model_validator(mode="after")
    def _check_target(self) -> Self:
        if (self.to is None) == (self.consumer is None):
            raise ValueError("give one of to and for")
        return self

    @property
    def _formats(self) -> tuple[frozenset[str], MeshFormat, str]:
        """Formats that are kept, the format to write, and the axis that is up in a glTF file."""
        if self.consumer is None:
            kind = cast("MeshFormat", self.to)
            return frozenset({kind}), kind, self.gltf_up
        found = consumers()[self.consumer]
        return frozenset(found.formats), found.written, found.gltf_up

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other mesh files."""
        bench, reported = self.workbench(sink), set[str]()

        def change(link: Link) -> Link:
            if not matches(link.name, self.links):
                return link
            update: dict[str, tuple[AnyShape, ...]] = {}
            if self.shapes != "collision":
                update["visuals"] = tuple(self._convert_shape(each, bench, reported) for each in link.visuals)
            if self.shapes != "visual":
                update["collisions"] = tuple(self._convert_shape(each, bench, reported) for each in link.collisions)
            changed = {name: new for name, new in update.items() if new != getattr(link, name)}
            return link.copy(**changed) if changed else link

        return rewrite(document, Link, change)

    def _convert_shape(self, shape: AnyShape, bench: Workbench, reported: set[str]) -> AnyShape:
        mesh = shape.geometry.shape if shape.geometry else None
        uri = (mesh.uri or "").strip() if isinstance(mesh, Mesh) else ""
        if not isinstance(mesh, Mesh) or not uri or uri.startswith("__"):
            return shape
        try:
            changed = self._convert_mesh(shape, mesh, bench, reported)
        except MeshError as error:
            if uri not in reported:
                report_kept_mesh(bench.sink, error, f"mesh {uri!r}", shape.location)
            reported.add(uri)
            return shape
        geometry = (shape.geometry or Geometry()).copy(shape=changed)
        return shape if changed is mesh else shape.copy(geometry=geometry)

    def _convert_mesh(self, shape: AnyShape, mesh: Mesh, bench: Workbench, reported: set[str]) -> Mesh:
        """The mesh with a new file; the mesh itself where it needs none.

        Raises:
            MeshError: the mesh has to stay.
        """
        uri = (mesh.uri or "").strip()
        kept, kind, gltf_up = self._formats
        own = kind_of(PurePosixPath(uri))
        if own in kept and not (own == "stl" and self._refuses_stl(uri, bench)):
            return mesh
        source = bench.sources.find(uri)
        _require_whole(source, uri, isinstance(shape, Visual) and not self.drop_appearance and kind != "stl")
        # No reader of URDF or SDF turns a COLLADA file by its <up_axis>: gz-common applies the unit
        # and never asks for the axis, RViz tells assimp to ignore it, PyBullet leaves the file as
        # it is. For glTF they differ: RViz and Drake turn y up to z up as the specification has it,
        # gz-common keeps the coordinates.
        up = gltf_up if self.consumer else self.gltf_up
        outcome = bench.outcome("convert", mesh, {"gltf_up": up, "to": kind})
        lost = cast("list[str]", outcome.result.facts["lost"])
        if lost and isinstance(shape, Visual) and not self.drop_appearance:
            message = f"{kind} has no {' and '.join(lost)}, which {uri!r} has"
            raise MeshError(KEPT_MESH, message, "choose another format, or give drop-appearance=true")
        new = bench.add(outcome.stem, outcome.result.files)
        if uri not in reported:
            bench.sink.report(CHANGED_MESH, f"mesh {uri!r} is written as {new!r}", shape.location, found=source.kind)
        reported.add(uri)
        return without_submesh(mesh).copy(uri=new)

    def _refuses_stl(self, uri: str, bench: Workbench) -> bool:
        """Whether the program reads STL, but not this file: one of text, or with too many triangles."""
        most = consumers()[self.consumer].binary_stl_up_to if self.consumer else None
        if most is None:
            return False
        try:
            content = bench.sources.find(uri).content
        except MeshError:
            return False  # it is reported where the files of the model are looked for
        number = triangles_of_binary_stl(content)
        return number is None or number > most


_STL_HEADER, _STL_TRIANGLE = 84, 50
"""The bytes of a binary STL file before its triangles, and of each of them."""


def triangles_of_binary_stl(content: bytes) -> int | None:
    """Return the number of triangles of a binary STL file; None for text, which has no room for that many."""
    number = int.from_bytes(content[80:_STL_HEADER], "little")
    whole = len(content) >= _STL_HEADER + _STL_TRIANGLE * number
    return number if len(content) >= _STL_HEADER and whole else None


def _require_whole(source: MeshSource, uri: str, looks_count: bool) -> None:
    """Raise where files that a mesh names are missing and needed.

    Raises:
        MeshError: textures, materials or buffers are missing.
    """
    missing = [name for name in source.missing if looks_count or name.endswith(".bin")]
    if missing:
        message = f"{missing[0]!r}, which {uri!r} names, is not found, or leads out of the folder of the mesh"
        raise MeshError(KEPT_MESH, message, "put it there, or give drop-appearance=true")


class Consumer(NamedTuple):
    """A program: its `formats`, the best one first, the versions that were `seen`, and the axis that is up in glTF.

    One with `binary_stl_up_to` reads STL as binary alone, up to so many triangles.
    """

    title: str
    seen: str
    formats: tuple[str, ...]
    gltf_up: str
    binary_stl_up_to: int | None = None

    @property
    def written(self) -> MeshFormat:
        """The best format among those that are written here."""
        return next(cast("MeshFormat", each) for each in self.formats if each in {"obj", "stl", "glb"})


@cache
def consumers() -> dict[str, Consumer]:
    """All programs by their names, from the table `data/consumers.toml`."""
    text = package_files("twinform.passes.meshes").joinpath("data", "consumers.toml").read_text(encoding="utf-8")
    return {
        name: Consumer(
            row["title"], row["seen"], tuple(row["formats"]), row.get("gltf_up", "z"), row.get("binary_stl_up_to")
        )
        for name, row in tomllib.loads(text).items()
    }
