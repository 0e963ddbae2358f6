"""Passes on meshes: what they leave alone, what they write, and where."""

import importlib
from pathlib import Path
from typing import Any

import pytest

import twinform
from twinform.installation import install_command
from twinform.ir import Collision, Document, Inertial, Link, Visual, rewrite
from twinform.passes import PipelineError, parse_pipeline
from twinform.passes.mesh_jobs.mesh_files import MARK
from twinform.passes.meshes.mesh_source import companions_of

trimesh: Any = importlib.import_module("trimesh")
ROBOT = """<robot name="r"><link name="base"/>
<link name="arm"><inertial><origin xyz="0 0 1"/><mass value="2"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual name="v"><geometry><mesh filename="in/ball.stl"/></geometry></visual>
<collision name="c"><origin xyz="0 1 0" rpy="0 0 1"/>
<geometry><mesh filename="in/ball.stl"/></geometry></collision></link>
<joint name="j" type="fixed"><parent link="base"/><child link="arm"/></joint></robot>"""
HULL = "simplify-collisions{how=hull triangles=60 max-relative-error=0.3}"
ALL = f"{HULL},decimate-visuals{{levels=2 max-relative-error=0.2}},convert-meshes{{to=obj}}"


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    (tmp_path / "in").mkdir()
    trimesh.creation.icosphere(2, 0.5).export(tmp_path / "in" / "ball.stl")
    (tmp_path / "r.urdf").write_text(ROBOT)
    return tmp_path / "r.urdf"


def _without_shapes(document: Document) -> Document:
    return rewrite(document, Link, lambda link: link.copy(visuals=(), collisions=()))


def test_nothing_but_shapes_changes(robot: Path) -> None:
    before, made = twinform.load(robot), twinform.convert(robot, to="urdf", passes=ALL)
    assert _without_shapes(made.document) == _without_shapes(before)
    assert twinform.loads(made.text) == made.document


def test_what_is_written_is_named_and_has_the_mark(robot: Path) -> None:
    made = twinform.convert(robot, to="urdf", passes=ALL)
    names = [each.path for each in made.side_files]
    assert names == ["meshes/ball_hull.obj", "meshes/ball_lod1.stl", "meshes/ball_lod2.stl", "meshes/ball_lod1.obj"]
    for each in made.side_files:
        assert MARK.encode() in each.data[:4096]
    uris = [line.split('"')[1] for line in made.text.splitlines() if "<mesh" in line]
    assert uris == ["meshes/ball_lod1.obj", "meshes/ball_hull.obj"]


def test_a_budget_of_triangles_is_kept(robot: Path) -> None:
    made = twinform.convert(robot, to="urdf", passes=HULL)
    hull = trimesh.load_mesh(trimesh.util.wrap_as_stream(made.side_files[0].data), file_type="obj")
    assert 4 <= len(hull.faces) <= 60


def test_two_meshes_of_one_name_get_two_files(robot: Path) -> None:
    other = robot.parent / "other"
    other.mkdir()
    trimesh.creation.icosphere(2, 0.25).export(other / "ball.stl")
    robot.write_text(ROBOT.replace("in/ball.stl", "other/ball.stl", 1))
    made = twinform.convert(robot, to="urdf", passes="convert-meshes{to=obj}")
    assert [each.path for each in made.side_files] == ["meshes/ball.obj", "meshes/ball_2.obj"]


def test_a_computed_inertia_keeps_its_collisions(robot: Path) -> None:
    mesh = f"<geometry><mesh><uri>{robot.parent}/in/ball.stl</uri></mesh></geometry>"
    link = f'<link name="l"><inertial auto="true"/><collision name="c">{mesh}</collision></link>'
    sdf = f'<sdf version="1.11"><model name="m">{link}</model></sdf>'
    made = twinform.convert(twinform.loads(sdf), to="sdf", passes="simplify-collisions")
    (kept,) = made.document.models[0].links
    assert kept.inertial == Inertial(auto=True)
    assert isinstance(kept.collisions[0], Collision)
    assert kept.collisions[0].geometry is not None
    assert kept.collisions[0].geometry.shape is not None
    assert kept.collisions[0].geometry.shape.kind == "mesh"
    assert [each.rule.name for each in made.diagnostics] == ["kept-mesh"]


def test_without_the_libraries_a_diagnostic_says_what_to_install(robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from twinform.passes.mesh_jobs.job import MeshJob, MeshResult  # noqa: PLC0415 - see above
    from twinform.passes.meshes import mesh_pass  # noqa: PLC0415 - it is patched

    def missing(job: MeshJob) -> MeshResult:
        del job
        return MeshResult({}, trouble="missing", message="coacd")

    monkeypatch.setattr(mesh_pass, "do", missing)
    monkeypatch.setenv("TWINFORM_MESH_CACHE", "off")
    made = twinform.convert(robot, to="urdf", passes="simplify-collisions")
    assert [(each.rule.name, each.help) for each in made.diagnostics] == [
        ("mesh-reader-missing", f"run: {install_command('meshes')}")
    ]


@pytest.mark.parametrize(
    "pipeline",
    [
        "convert-meshes",
        "convert-meshes{to=obj for=mujoco}",
        "convert-meshes{for=blender}",
        "decimate-visuals{levels=2 use=3}",
        "simplify-collisions{folder=../x}",
        "simplify-collisions{prefix=/etc}",
        "simplify-collisions{max-error=0}",
        "simplify-collisions{how=[]}",
    ],
)
def test_options_that_make_no_sense_are_refused(pipeline: str) -> None:
    with pytest.raises(PipelineError):
        parse_pipeline(pipeline)


def test_a_pipeline_is_its_text(robot: Path) -> None:
    del robot
    text = 'convert-meshes{for=mujoco},simplify-collisions{how=hull prefix="package://arm"}'
    assert parse_pipeline(str(parse_pipeline(text))) == parse_pipeline(text)


def test_a_mesh_names_no_file_outside_of_its_neighborhood(tmp_path: Path) -> None:
    folder = tmp_path / "package" / "meshes"
    folder.mkdir(parents=True)
    (tmp_path / "package" / "package.xml").write_text("<package><name>package</name></package>")
    (tmp_path / "secret.png").write_bytes(b"secret")
    (tmp_path / "package" / "textures").mkdir()
    (tmp_path / "package" / "textures" / "a.png").write_bytes(b"image")
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    (folder / "m.mtl").write_text(
        "map_Kd ../textures/a.png\nmap_Kd ../../secret.png\nmap_Kd link.png\nmap_Kd /etc/passwd\nmap_Ka gone.png\n"
    )
    found = companions_of(folder / "m.obj", "obj", b"mtllib m.mtl\nmtllib ../../../etc/passwd\n")
    assert sorted(found.files) == ["../textures/a.png", "m.mtl"]
    assert sorted(found.missing) == sorted(
        ["../../../etc/passwd", "../../secret.png", "link.png", "/etc/passwd", "gone.png"]
    )


def test_a_unit_of_collada_is_meters_afterwards(tmp_path: Path) -> None:
    text = trimesh.creation.box((1, 2, 3)).export(file_type="dae").decode()
    (tmp_path / "b.dae").write_text(text.replace("<up_axis>", '<unit name="inch" meter="0.0254"/><up_axis>'))
    (tmp_path / "r.urdf").write_text(
        '<robot name="r"><link name="l"><visual><geometry><mesh filename="b.dae"/></geometry></visual></link></robot>'
    )
    made = twinform.convert(tmp_path / "r.urdf", to="urdf", passes="convert-meshes{to=stl drop-appearance=true}")
    whole = trimesh.load_mesh(trimesh.util.wrap_as_stream(made.side_files[0].data), file_type="stl")
    assert whole.extents.round(6).tolist() == [0.0254, 0.0508, 0.0762]
    assert isinstance(made.document.models[0].links[0].visuals[0], Visual)
