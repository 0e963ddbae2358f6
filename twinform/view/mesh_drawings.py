"""The triangles of mesh files, read in a process of its own."""

from collections.abc import Mapping
from pathlib import Path

from twinform.compiler.search.resolve_uris import LocalAssets, SearchPath
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Mesh
from twinform.passes import NO_ASSETS
from twinform.passes.analyses.mesh_solids import MeshError
from twinform.passes.meshes.mesh_pass import Workbench
from twinform.passes.meshes.mesh_source import MeshSources


class MeshDrawings:
    """The meshes that the file `beside` names, each drawn once; `gltf_up` is the axis that is up in a glTF file."""

    def __init__(self, search: SearchPath | None = None, beside: Path | None = None, *, gltf_up: str = "z") -> None:
        assets = LocalAssets(search, beside) if search and beside else NO_ASSETS
        sink = DiagnosticSink()
        self._bench = Workbench(sink, MeshSources(assets, sink), folder="", prefix="")
        self._options = {"gltf_up": gltf_up}
        self._known: dict[tuple[str, object], Mapping[str, bytes] | str] = {}

    def drawing(self, mesh: Mesh) -> Mapping[str, bytes] | str:
        """`points`, `faces` and perhaps `colors` of a mesh without its scale; a text where it cannot be drawn."""
        uri = (mesh.uri or "").strip()
        if not uri:
            return "it names no mesh"
        key = (uri, mesh.opaque)
        if key not in self._known:
            self._known[key] = self._drawn(mesh)
        return self._known[key]

    def _drawn(self, mesh: Mesh) -> Mapping[str, bytes] | str:
        try:
            # A mesh is a file of a stranger: the confined child process hands over arrays of
            # numbers. Textures become colors of vertices there, which needs no second kind of
            # material and is enough to recognize a robot.
            return self._bench.outcome("draw", mesh, self._options).result.files
        except MeshError as error:
            return error.message
