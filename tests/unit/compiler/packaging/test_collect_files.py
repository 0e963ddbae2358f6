"""Files that passes have made come into a package, whether or not anybody has written them."""

from pathlib import Path
from typing import ClassVar

import pytest

from tests.unit.compiler.packaging.robots import MTL, OBJ, PNG, arm
from twinform.compiler import CompileError, ConversionRequest, LoadOptions, SearchPath
from twinform.compiler.packaging.kinds import build
from twinform.compiler.packaging.order import Order
from twinform.diagnostics import DiagnosticSink, SideFile
from twinform.ir import Document
from twinform.passes import Pass, Pipeline
from twinform.passes.shared.document_uris import map_uris

_MADE = {"meshes/hull.obj": OBJ, "meshes/arm.mtl": MTL, "textures/skin.png": PNG, "config/bridge.yaml": b"[]"}


class MakeMeshes(Pass):
    """Says another mesh for every one of them, and makes its file."""

    name: ClassVar[str] = "make-meshes"
    uri: str = "meshes/hull.obj"
    also: str = ""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        made = {**_MADE, **({self.also: b"other"} if self.also else {})}
        sink.side_files += [SideFile(path, data) for path, data in made.items()]
        return map_uris(document, lambda uri, kind, _: self.uri if kind == "mesh" else uri)


def _files(source: Path, step: MakeMeshes) -> dict[str, bytes | Path]:
    order = Order(
        source=str(source),
        source_name=str(source),
        name="m",
        folder="m",
        conversion=ConversionRequest(to="sdf", passes=Pipeline((step,))),
        load_options=LoadOptions(search=SearchPath.of([]), tolerant=True),
        sdf_versions=("1.9", "1.6"),
    )
    return dict(build(order, ("gazebo-model",)).package.files)


@pytest.mark.slow
@pytest.mark.parametrize("uri", ["meshes/hull.obj", "package://arm_description/meshes/hull.obj"])
def test_made_files_keep_their_paths(tmp_path: Path, uri: str) -> None:
    files = _files(arm(tmp_path), MakeMeshes(uri=uri))
    assert {path: files[path] for path in _MADE} == _MADE
    for text in (files["model.sdf"], files["model-1_6.sdf"]):
        assert isinstance(text, bytes)
        assert text.count(b"<uri>model://m/meshes/hull.obj</uri>") == 3
    assert "meshes/visual/base.obj" not in files
    assert "thumbnails/1.png" in files


def test_a_made_file_in_the_place_of_another_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(CompileError, match="another file of the package is there"):
        _files(arm(tmp_path), MakeMeshes(also="model.config"))
