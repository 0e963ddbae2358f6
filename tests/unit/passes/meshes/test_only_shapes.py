"""Whatever the robot, passes on meshes change no mass, no inertia, no frame and no joint."""

import importlib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.mesh_folder import MeshFolder
from tests.profile import examples
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Document, Geometry, Link, Mesh, Node, Visual, rewrite
from twinform.ir.verify import verify
from twinform.passes import parse_pipeline
from twinform.testing import oracles, strategies

_ROVER = Path(__file__).parents[4] / "examples" / "rover.urdf"
trimesh: Any = importlib.import_module("trimesh")
PASSES = parse_pipeline("simplify-collisions{how=[primitive,hull]},decimate-visuals{share=0.3},convert-meshes{to=obj}")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> MeshFolder:
    folder = tmp_path_factory.mktemp("meshes")
    trimesh.creation.icosphere(1, 0.3).export(folder / "a.stl")
    trimesh.creation.cone(0.2, 0.5, sections=8).export(folder / "b.ply")
    return MeshFolder(folder)


def _with_meshes(document: Document) -> Document:
    uris = iter(["a.stl", "b.ply"] * 10_000)

    def change(node: Node) -> Node:
        if isinstance(node, Visual | Collision) and node.geometry:
            return node.copy(geometry=Geometry(shape=Mesh(uri=next(uris))))
        return node

    return rewrite(document, Node, change)


def _bones(document: Document) -> Document:
    return rewrite(document, Link, lambda link: link.copy(visuals=(), collisions=()))


@pytest.mark.slow
@examples(0.3)
@given(st.one_of(strategies.robots(), strategies.sdf_models()))
def test_only_shapes_change(folder: MeshFolder, drawn: Document) -> None:
    document, sink = _with_meshes(drawn), DiagnosticSink()
    made = PASSES.with_files(folder).run(document, sink, verify=verify)
    assert _bones(made) == _bones(document)


@pytest.mark.skipif(not oracles.available("drake"), reason="Drake is not installed")
def test_drake_sees_the_same_robot(folder: MeshFolder, tmp_path: Path) -> None:
    document = _with_meshes(twinform.load(_ROVER))
    made = PASSES.with_files(folder).run(document, DiagnosticSink())
    assert made != document
    for name, each in (("before", document), ("after", made)):
        (tmp_path / f"{name}.urdf").write_text(twinform.convert(_bones(each), to="urdf").text)
    assert oracles.compare(tmp_path / "before.urdf", tmp_path / "after.urdf")
