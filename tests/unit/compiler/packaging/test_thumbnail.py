"""The picture of a model: what is in it, where, and in which color."""

import io
import sys
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

import twinform
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.package import PackageLayout
from twinform.compiler.packaging.thumbnail import thumbnail
from twinform.diagnostics import DiagnosticSink
from twinform.installation import install_command

pytestmark = pytest.mark.slow

_VISUAL = """<visual name="{name}"><pose>{pose} 0 0 0</pose><geometry>{shape}</geometry><material>
<diffuse>{color} 1</diffuse></material></visual>"""
_BALL = "<sphere><radius>1</radius></sphere>"
_SHAPES = (
    "<box><size>1 2 3</size></box>",
    _BALL,
    "<cylinder><radius>1</radius><length>2</length></cylinder>",
    "<capsule><radius>1</radius><length>2</length></capsule>",
    "<cone><radius>1</radius><length>2</length></cone>",
    "<ellipsoid><radii>1 2 3</radii></ellipsoid>",
)
_TEXT = '<sdf version="1.12"><model name="m"><link name="l">{}</link></model></sdf>'
_BEHIND = (245, 246, 248)


def _visual(name: str, pose: str, color: str, shape: str = _BALL) -> str:
    return _VISUAL.format(name=name, pose=pose, color=color, shape=shape)


def _drawn(*visuals: str) -> tuple[bytes | None, DiagnosticSink]:
    sink = DiagnosticSink()
    return thumbnail(
        twinform.loads(_TEXT.format("".join(visuals)).encode()), Collection(PackageLayout({"model": "m"})), sink
    ), sink


def _picture(*visuals: str) -> Any:
    data, _ = _drawn(*visuals)
    assert data is not None
    return Image.open(io.BytesIO(data)).convert("RGB")


def _is_red(pixel: tuple[int, int, int]) -> bool:
    return pixel[0] > 80 and pixel[1] < 20 and pixel[2] < 20


@pytest.mark.parametrize("shape", _SHAPES)
def test_every_shape_fills_the_picture_and_stays_in_it(shape: str) -> None:
    picture = _picture(_visual("v", "5 6 7", "1 0 0", shape))
    assert picture.size == (512, 512)
    assert _is_red(picture.getpixel((256, 256)))
    box = Image.eval(picture.split()[1], lambda value: 255 if value < 200 else 0).getbbox()
    assert box is not None
    assert min(box[:2]) >= 25
    assert max(box[2:]) <= 512 - 25
    assert max(box[2] - box[0], box[3] - box[1]) >= 440
    assert picture.getpixel((2, 2)) == _BEHIND


def test_what_is_nearer_hides_what_is_behind() -> None:
    behind, front = _visual("a", "0 0 0", "0 0 1"), _visual("b", "7.5 -5 4.3", "1 0 0")
    for both in ((behind, front), (front, behind)):
        assert _is_red(_picture(*both).getpixel((256, 256)))


def test_up_is_up_and_the_front_looks_to_the_right() -> None:
    top = _picture(_visual("a", "0 0 0", "0 0 1"), _visual("b", "0 0 6", "1 0 0"))
    assert _is_red(top.getpixel((256, 80)))
    front = _picture(_visual("a", "0 0 0", "0 0 1"), _visual("b", "6 0 0", "1 0 0"))
    reds = [x for x in range(0, 512, 4) for y in range(0, 512, 4) if _is_red(front.getpixel((x, y)))]
    assert reds
    assert min(reds) > 256


def test_the_same_model_gives_the_same_bytes() -> None:
    visuals = [_visual(str(number), f"{number} 0 0", "1 0 0", shape) for number, shape in enumerate(_SHAPES)]
    assert _drawn(*visuals)[0] == _drawn(*visuals)[0]


@pytest.mark.parametrize("visuals", [[], [_visual("v", "0 0 0", "1 0 0", "<mesh><uri>model://m/no.stl</uri></mesh>")]])
def test_nothing_to_be_drawn_is_a_note(visuals: list[str]) -> None:
    data, sink = _drawn(*visuals)
    assert data is None
    assert [(each.rule.name, each.message) for each in sink.diagnostics] == [
        ("no-thumbnail", "model 'm' has no thumbnail: nothing of it can be drawn")
    ]


def test_corners_that_are_no_numbers_are_left_out(tmp_path: Path) -> None:
    mesh = tmp_path / "m.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 1\nv nan 0 0\nf 1 2 3\nf 1 2 4\n")
    collection = Collection(PackageLayout({"model": "m"}), files={"meshes/m.obj": mesh})
    shape = "<mesh><uri>model://m/meshes/m.obj</uri></mesh>"
    document = twinform.loads(_TEXT.format(_visual("v", "0 0 0", "1 0 0", shape)).encode())
    assert thumbnail(document, collection, DiagnosticSink())


def test_libraries_that_are_missing_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "PIL.Image", None)
    data, sink = _drawn(_visual("v", "0 0 0", "1 0 0"))
    assert data is None
    assert f"run: {install_command('thumbnails')}" in sink.diagnostics[0].message
