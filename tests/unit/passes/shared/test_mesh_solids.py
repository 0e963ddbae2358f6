"""Meshes as solids, judged by closed forms."""

import importlib
import math
import struct
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.mesh_folder import MeshFolder
from twinform.installation import install_command
from twinform.ir import Element, Mesh, Opaque
from twinform.ir.geometry import Box
from twinform.ir.solids import Solid, solid
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult
from twinform.passes.shared.mesh_solids import MeshError, Meshes

trimesh: Any = importlib.import_module("trimesh")
_EXPORTED = ("stl", "obj", "dae", "ply", "off", "glb")
FORMATS = (*_EXPORTED, "msh")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Boxes of 1 x 2 x 3 m in every format, and meshes without an inside."""
    folder = tmp_path_factory.mktemp("meshes")
    box = trimesh.creation.box((1, 2, 3))
    for kind in _EXPORTED:
        box.export(folder / f"box.{kind}")
    counts = struct.pack("<4i", len(box.vertices), 0, 0, len(box.faces))
    (folder / "box.msh").write_bytes(counts + box.vertices.astype("<f4").tobytes() + box.faces.astype("<i4").tobytes())
    (folder / "short.msh").write_bytes(counts)
    (folder / "wrong.msh").write_bytes(struct.pack("<4i12f3i", 4, 0, 0, 1, *[0.0] * 12, 0, 1, 9))
    text = (folder / "box.dae").read_text()
    (folder / "centimeters.dae").write_text(text.replace("<up_axis>", '<unit name="cm" meter="0.01"/><up_axis>'))
    two = trimesh.Scene({"near": box, "far": box.copy().apply_translation((9, 0, 0))})
    two.export(folder / "two.glb")
    inward = box.copy()
    inward.invert()
    inward.export(folder / "inward.stl")
    holed, mixed = box.copy(), box.copy()
    holed.faces = holed.faces[1:]
    holed.export(folder / "holed.stl")
    faces = mixed.faces.copy()
    faces[0] = faces[0][::-1]
    trimesh.Trimesh(mixed.vertices, faces, process=False).export(folder / "mixed.stl")
    trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).export(folder / "flat.stl")
    (folder / "empty.stl").write_bytes(b"")
    (folder / "noise.dae").write_bytes(b"\x00\xff<COLLADA>")
    (folder / "hostile.obj").write_text("f 1 2 99999999999\nmtllib /etc/passwd\n")
    (folder / "hostile.dae").write_text(f"<!DOCTYPE x SYSTEM 'file:///etc/passwd'>{text[text.index('<COLLADA') :]}")
    (folder / "part.step").write_text("ISO-10303-21;")
    return folder


def meshes(folder: Path, *, hull: bool = False) -> Meshes:
    return Meshes(MeshFolder(folder), hull)


def same(one: Solid, other: Solid, exact: float = 1e-12) -> bool:
    numbers = [(one.mass, *one.center, *one.inertia), (other.mass, *other.center, *other.inertia)]
    scale = max(map(abs, numbers[1]))
    return all(abs(a - b) <= exact * scale for a, b in zip(*numbers, strict=True))


BOX = solid(Box(size=(1, 2, 3)), 700) or Solid(0, (0, 0, 0), (0, 0, 0, 0, 0, 0))


@pytest.mark.parametrize("kind", FORMATS)
def test_a_box_is_the_box_of_the_closed_form_in_every_format(folder: Path, kind: str) -> None:
    assert same(meshes(folder).solid(Mesh(uri=f"box.{kind}"), 700), BOX)


SIZES = st.floats(0.01, 10) | st.floats(-10, -0.01)


@settings(max_examples=20)  # each is a job of another process
@given(scale=st.tuples(SIZES, SIZES, SIZES))
@example(scale=(1.0, 1.0, 1.000000001))  # trimesh takes it for one
def test_a_scaled_box_is_the_scaled_box_mirrored_or_not(folder: Path, scale: tuple[float, float, float]) -> None:
    found = meshes(folder).solid(Mesh(uri="box.stl", scale=scale), 1000)
    x, y, z = map(abs, scale)
    expected = solid(Box(size=(x, 2 * y, 3 * z)), 1000)
    assert expected
    assert same(found, expected)
    assert meshes(folder).bounds(Mesh(uri="box.stl", scale=scale))[1] == pytest.approx((x / 2, y, 1.5 * z))


def test_a_mesh_that_is_turned_inside_out_is_turned_back(folder: Path) -> None:
    assert same(meshes(folder).solid(Mesh(uri="inward.stl"), 700), BOX)


def test_a_collada_file_has_its_unit(folder: Path) -> None:
    assert meshes(folder).solid(Mesh(uri="centimeters.dae"), 1e6).mass == pytest.approx(6)


def test_a_round_mesh_comes_near_the_ball(folder: Path) -> None:
    trimesh.creation.icosphere(subdivisions=5, radius=0.5).export(folder / "ball.stl")
    found = meshes(folder).solid(Mesh(uri="ball.stl"), 1)
    assert found.inertia[0] == pytest.approx(2 / 5 * found.mass * 0.25, rel=2e-3)
    assert found.mass == pytest.approx(math.pi / 6, rel=2e-3)


def submesh(name: str, center: str = "") -> Mesh:
    children = (Element(name="name", text=name), Element(name="center", text=center or "false"))
    return Mesh(uri="two.glb", opaque=(Opaque(element=Element(name="submesh", children=children)),))


def test_a_submesh_is_a_part_and_may_be_centered(folder: Path) -> None:
    both = meshes(folder)
    assert both.solid(Mesh(uri="two.glb"), 1).mass == pytest.approx(12)
    assert both.solid(submesh("far"), 1).center == pytest.approx((9, 0, 0))
    assert both.solid(submesh("far", "true"), 1).center == pytest.approx((0, 0, 0))
    with pytest.raises(MeshError, match="no submesh 'third', it has far, near"):
        both.solid(submesh("third"), 1)


@pytest.mark.parametrize(
    ("uri", "rule", "words"),
    [
        ("holed.stl", "open-mesh", "holes"),
        ("mixed.stl", "open-mesh", "do not agree"),
        ("flat.stl", "open-mesh", "holes"),
        ("empty.stl", "unreadable-mesh", "empty.stl"),
        ("noise.dae", "unreadable-mesh", "noise.dae"),
        ("hostile.obj", "unreadable-mesh", "hostile.obj"),
        ("hostile.dae", "unreadable-mesh", "document type"),
        ("short.msh", "unreadable-mesh", "its size is not that of"),
        ("wrong.msh", "unreadable-mesh", "names a point"),
        ("part.step", "unreadable-mesh", "dae, glb, msh"),
        ("missing.stl", "unreadable-mesh", "missing.stl"),
    ],
)
def test_what_has_no_inside_is_reported(folder: Path, uri: str, rule: str, words: str) -> None:
    with pytest.raises(MeshError, match=words) as caught:
        meshes(folder).solid(Mesh(uri=uri), 1)
    assert caught.value.rule.name == rule


def test_the_hull_stands_for_an_open_mesh_if_it_may(folder: Path) -> None:
    assert same(meshes(folder, hull=True).solid(Mesh(uri="holed.stl"), 700), BOX)
    with pytest.raises(MeshError, match=r"flat\.stl"):
        meshes(folder, hull=True).solid(Mesh(uri="flat.stl"), 1)


def test_without_the_library_it_reports_what_to_install(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    missing = MeshResult({}, trouble="missing", message="trimesh")

    def do(job: MeshJob) -> MeshResult:
        del job
        return missing

    monkeypatch.setattr("twinform.passes.mesh_jobs.child_process.do", do)
    with pytest.raises(MeshError, match="trimesh is not installed") as caught:
        meshes(folder).solid(Mesh(uri="box.stl"), 1)
    assert caught.value.rule.name == "mesh-reader-missing"
    assert caught.value.help == f"run: {install_command('meshes')}"


@pytest.mark.parametrize("away", [0.0, 1e3, 1e6, 1e8])
def test_a_mesh_far_from_the_origin_turns_as_one_that_is_near(tmp_path: Path, away: float):
    trimesh.creation.box(bounds=[(away, 0, 0), (away + 1, 2, 4)]).export(tmp_path / "far.obj", digits=17)
    found = Meshes(MeshFolder(tmp_path)).solid(Mesh(uri="far.obj"), 12.0)
    assert found.mass == pytest.approx(96.0)
    assert found.center == pytest.approx((away + 0.5, 1.0, 2.0))
    assert found.inertia == pytest.approx((8 * 20, 8 * 17, 8 * 5, 0.0, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("scale", [1e-60, 1e-30, 1e30, 1e60])
def test_a_mesh_of_any_size_is_a_solid(tmp_path: Path, scale: float):
    trimesh.creation.box(extents=(1, 2, 4)).export(tmp_path / "box.stl")
    found = Meshes(MeshFolder(tmp_path)).solid(Mesh(uri="box.stl", scale=(scale, scale, scale)), 12.0)
    assert found.mass == pytest.approx(96.0 * scale * scale * scale)
    squared = 8 * scale * scale * scale * scale * scale
    assert found.inertia[:3] == pytest.approx((20 * squared, 17 * squared, 5 * squared), rel=1e-9, abs=0)
