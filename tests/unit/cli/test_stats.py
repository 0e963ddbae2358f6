"""Models in numbers."""

import json
from pathlib import Path
from typing import Any

import pytest

from twinform.installation import install_command
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

from .conftest import BROKEN, WRONG, Run

_EXAMPLES = Path(__file__).parents[3] / "examples"
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4 2\n"
STL = (
    "solid a\n"
    + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n" * 3
    + "endsolid a\n"
)
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
      <accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
        <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node><instance_geometry url="#g"/></node><node><translate>1 0 0</translate><instance_geometry url="#g"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""  # fmt: skip


def stats(run: Run, *arguments: str | Path, text: str | None = None) -> dict[str, Any]:
    """What is known of the only file."""
    done = run("stats", *arguments, "--format", "json", text=text)
    assert done.exit_code == 0, done.stderr
    (found,) = json.loads(done.stdout)["files"]
    return found


def of_sdf(run: Run, content: str) -> dict[str, Any]:
    """What is known of a model with this content."""
    text = f'<sdf version="1.11"><model name="m">{content}</model></sdf>'
    return stats(run, "-", text=text)["models"][0]


def test_a_robot_in_numbers(run: Run) -> None:
    (arm,) = stats(run, _EXAMPLES / "arm.urdf")["models"]
    assert (arm["links"], arm["dof"], arm["depth"], arm["loops"]) == (12, 7, 10, 0)
    assert arm["joints"] == {"fixed": 3, "prismatic": 2, "revolute": 6}
    assert arm["mass"] == pytest.approx(16.42)
    assert arm["visuals"] == {"mesh": 10}
    assert arm["collisions"] == {"box": 3, "cylinder": 5, "mesh": 2}
    finger = next(each for each in arm["meshes"] if each["uri"].endswith("finger.stl"))
    size = (_EXAMPLES / "twinform_arm/meshes/finger.stl").stat().st_size
    assert (finger["bytes"], finger["triangles"], finger["visuals"], finger["collisions"]) == (size, 12, 2, 0)


def test_the_content_of_gazebo_elements_counts(run: Run) -> None:
    (rover,) = stats(run, _EXAMPLES / "rover.urdf")["models"]
    assert rover["sensors"] == {"camera": 1, "imu": 1}
    assert list(rover["plugins"]) == ["gz-sim-diff-drive-system", "gz-sim-joint-state-publisher-system"]


def test_a_world_has_numbers_for_each_model(run: Run) -> None:
    (world,) = stats(run, _EXAMPLES / "warehouse.sdf")["worlds"]
    assert [model["name"] for model in world["models"]] == ["ground_plane", "shelf", "lift_cart"]
    assert (world["includes"], world["lights"]) == (1, 2)
    (world,) = stats(run, _EXAMPLES / "warehouse.sdf", "--expand-includes", "--path", _EXAMPLES)["worlds"]
    assert (len(world["models"]), world["includes"]) == (4, 0)


LINKS = "".join(f'<link name="{name}"/>' for name in "abcd")


def joint(name: str, kind: str, parent: str, child: str, more: str = "") -> str:
    axis = "" if kind in {"fixed", "ball"} else f"<axis><xyz>0 0 1</xyz>{more}</axis>"
    axis += "<axis2><xyz>1 0 0</xyz></axis2>" if kind in {"universal", "revolute2"} else ""
    return f'<joint name="{name}" type="{kind}"><parent>{parent}</parent><child>{child}</child>{axis}</joint>'


MIMIC = '<mimic joint="1"><multiplier>2</multiplier></mimic>'
FRAME = '<frame name="f" attached_to="b"/>'
NESTED = f'<model name="n">{LINKS}{joint("1", "revolute", "a", "b")}</model>'


@pytest.mark.parametrize(
    ("joints", "dof", "depth", "loops"),
    [
        ("", 0, 0, 0),
        (joint("1", "fixed", "a", "b"), 0, 1, 0),
        (joint("1", "fixed", "world", "a"), 0, 1, 0),
        (joint("1", "revolute", "a", "b") + joint("2", "prismatic", "b", "c"), 2, 2, 0),
        (joint("1", "universal", "a", "b") + joint("2", "ball", "a", "c"), 5, 1, 0),
        (joint("1", "screw", "b", "a") + joint("2", "screw", "c", "b") + joint("3", "screw", "d", "c"), 3, 3, 0),
        (joint("1", "revolute", "a", "b") + joint("2", "revolute", "a", "c", MIMIC), 1, 1, 0),
        ("".join(joint(a + b, "revolute", a, b) for a, b in ("ab", "bc", "cd", "da")), 4, 3, 1),
        (FRAME + joint("1", "revolute", "a", "f") + joint("2", "revolute", "f", "c"), 2, 2, 0),
        (NESTED + joint("2", "revolute", "a", "n::a"), 2, 2, 0),
    ],
)  # fmt: skip
def test_joints_and_their_tree_are_counted(run: Run, joints: str, dof: int, depth: int, loops: int) -> None:
    found = of_sdf(run, LINKS + joints)
    assert (found["dof"], found["depth"], found["loops"]) == (dof, depth, loops)


def test_what_stands_in_the_world_of_mjcf_weighs_nothing(run: Run) -> None:
    body = "<body name='b' pos='0 0 1'><freejoint/><geom size='0.1' mass='2'/></body>"
    found = stats(run, "-", text=f"<mujoco><worldbody><geom type='plane' size='1 1 1'/>{body}</worldbody></mujoco>")
    models = [*found["models"], *(each for world in found["worlds"] for each in world["models"])]
    assert sorted(each["mass"] for each in models) == [0.0, 2.0]
    assert [each["masses_assumed"] for each in models] == [0, 0]


def test_masses_that_nobody_wrote(run: Run) -> None:
    box = "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>"
    plane = "<collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>"
    found = of_sdf(
        run,
        f"<link name='a'/><link name='b'><inertial><mass>2</mass></inertial></link>"
        f"<link name='c'><inertial auto='true'><density>10</density></inertial>{box}</link>"
        f"<link name='d'><inertial auto='true'/>{plane}</link>",
    )
    assert (found["mass"], found["masses_assumed"], found["masses_unknown"]) == (pytest.approx(13), 1, 1)


DOCTYPE = DAE.replace("<COLLADA", "<!DOCTYPE x SYSTEM 'file:///etc/passwd'><COLLADA")


@pytest.mark.parametrize(
    ("name", "content", "triangles", "problem"),
    [
        pytest.param("a.obj", OBJ, 4, "", id="obj"),
        pytest.param("a.STL", STL, 3, "", id="stl"),
        pytest.param("a.dae", DAE, 2, "", id="dae"),
        pytest.param("a.dae", DOCTYPE, None, "it declares a document type", id="hostile dae"),
        pytest.param("a.dae", "<COLLADA", None, "its reader stops at it", id="broken dae"),
        pytest.param("a.stl", "", None, "it has no triangles", id="empty stl"),
        # which of the two is reported depends on the decoders that are installed beside trimesh
        pytest.param("a.stl", "\0" * 80 + "\xff" * 4, None, "it ", id="stl that promises too much"),
        pytest.param("a.obj", "# nothing", None, "it ", id="empty obj"),
        pytest.param("a.blend", "BLENDER", None, "triangles are counted in dae, glb, msh", id="another format"),
    ],
)
def test_a_mesh_costs_bytes_and_triangles(
    run: Run, tmp_path: Path, name: str, content: str, triangles: int | None, problem: str
) -> None:
    (tmp_path / name).write_bytes(content.encode("latin-1"))
    model = tmp_path / "model.sdf"
    shape = f"<geometry><mesh><uri>{name}</uri></mesh></geometry>"
    model.write_text(
        f'<sdf version="1.11"><model name="m"><link name="a"><visual name="v">{shape}</visual></link></model></sdf>'
    )
    (cost,) = stats(run, model)["models"][0]["meshes"]
    assert cost["bytes"] == len(content)
    assert (cost["triangles"] or None, cost["problem"][: len(problem)]) == (triangles, problem)
    assert bool(cost["problem"]) is bool(problem)
    (unseen,) = stats(run, model, "--no-meshes")["models"][0]["meshes"]
    assert (unseen["bytes"], unseen["visuals"]) == (None, 1)


def test_a_mesh_that_is_filled_weighs_what_it_holds(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    model = tmp_path / "model.sdf"
    model.write_text(
        '<sdf version="1.11"><model name="m"><link name="a"><inertial auto="true"><density>6</density></inertial>'
        '<collision name="c"><geometry><mesh><uri>a.obj</uri></mesh></geometry></collision></link></model></sdf>'
    )
    assert stats(run, model)["models"][0]["mass"] == pytest.approx(1)
    assert stats(run, model, "--no-meshes")["models"][0]["masses_unknown"] == 1


def test_a_mesh_that_is_not_there_is_reported(run: Run, tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text((_EXAMPLES / "arm.urdf").read_text())
    costs = stats(run, tmp_path / "arm.urdf")["models"][0]["meshes"]
    assert all("is not found" in each["problem"] and each["bytes"] is None for each in costs)


def test_without_trimesh_the_bytes_are_known(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def do(job: MeshJob) -> MeshResult:
        del job
        return MeshResult({}, trouble="missing", message="trimesh")

    monkeypatch.setattr("twinform.passes.mesh_jobs.child_process.do", do)
    costs = stats(run, _EXAMPLES / "arm.urdf")["models"][0]["meshes"]
    assert all(each["bytes"] and each["triangles"] is None for each in costs)
    assert install_command("meshes") in costs[0]["problem"]


def test_text_is_for_people(run: Run) -> None:
    lines = run("stats", _EXAMPLES / "arm.urdf").stdout.splitlines()
    assert "  freedoms    7" in lines
    assert "  meshes      7 files, 15.6 kB, 460 triangles drawn, 24 for contact" in lines
    assert "              package://twinform_arm/meshes/finger.stl: 1.32 kB, 12 triangles, 2 visuals" in lines


def test_what_cannot_be_read_stops_no_other(run: Run, tmp_path: Path) -> None:
    for name, text in {"broken": BROKEN, "wrong": WRONG}.items():
        (tmp_path / f"{name}.urdf").write_text(text)
    done = run("stats", tmp_path / "wrong.urdf", _EXAMPLES / "rover.urdf")
    assert (done.exit_code, "model 'rover'" in done.stdout) == (1, True)
    assert run("stats", tmp_path / "broken.urdf", tmp_path / "wrong.urdf").exit_code == 2


SENSING = """<robot name="r"><link name="base"/><gazebo reference="base">
<sensor name="scan" type="ray"><ray><scan><horizontal><samples>3600</samples></horizontal></scan></ray></sensor>
<sensor name="eye" type="camera"><update_rate>60</update_rate><camera><image><width>1280</width><height>720</height>
</image></camera></sensor></gazebo></robot>"""


def test_the_cost_of_sensors_comes_with_what_to_do(run: Run, tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text(SENSING)
    (cost,) = [model["cost"] for model in stats(run, tmp_path / "r.urdf")["models"]]
    assert (cost["pixels_per_second"], cost["rays_per_second"], cost["rates_assumed"]) == (60 * 1280 * 720, 3.6e6, 1)
    assert [each["category"] for each in cost["advice"]] == ["sensors", "sensors"]
    passes = ",".join(each["passes"] for each in cost["advice"])
    done = run("convert", tmp_path / "r.urdf", "-o", tmp_path / "cheap.urdf", "--passes", passes)
    assert done.exit_code == 0, done.stderr
    (cost,) = [model["cost"] for model in stats(run, tmp_path / "cheap.urdf")["models"]]
    assert cost["advice"] == []


def test_a_model_that_costs_little_needs_no_advice(run: Run, tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text('<robot name="r"><link name="base"/></robot>')
    assert "cheaper" not in run("stats", tmp_path / "r.urdf").output


def test_a_mimic_of_a_fixed_joint_takes_nothing_away(run: Run) -> None:
    joint = '<joint name="{0}" type="{1}"><parent link="a"/><child link="{0}_link"/>{2}</joint>'
    joints = joint.format("turn", "continuous", "") + joint.format("rigid", "fixed", '<mimic joint="turn"/>')
    links = "".join(f'<link name="{name}"/>' for name in ("a", "turn_link", "rigid_link"))
    assert stats(run, "-", text=f'<robot name="r">{links}{joints}</robot>')["models"][0]["dof"] == 1
