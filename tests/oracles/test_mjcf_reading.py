"""What is read of MJCF is the robot that MuJoCo reads: random models, and the cases that are written by hand."""

import struct
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.mjcf.of_mjcf import differences_in_sdf, differences_in_urdf, trees_of, without_rotors
from tests.oracles.mjcf_models import random_model

pytest.importorskip("pydrake")
mujoco: Any = pytest.importorskip("mujoco")
trimesh: Any = pytest.importorskip("trimesh")

_CASES = Path(__file__).parents[1] / "cases/from_mjcf"
_NO_MESHES = [each for each in sorted(_CASES.glob("*.mjcf")) if "<mesh" not in each.read_text()]


def differences(path: Path) -> list[str]:
    """What differs between MuJoCo's reading of a file and ours."""
    source, made = without_rotors(mujoco, path), twinform.convert(path, to="sdf")
    found = differences_in_sdf(source, made)
    trees = trees_of(source, made.document)
    for tree in () if isinstance(trees, str) else trees:
        chosen = None if made.document.models else tree.model.name
        found += differences_in_urdf(source, tree, twinform.convert(path, to="urdf", model=chosen))
    return found


@pytest.mark.parametrize("seed", range(30))
def test_a_random_model_is_the_same_robot(seed: int, tmp_path: Path) -> None:
    source = tmp_path / "model.xml"
    source.write_text(random_model(seed))
    assert differences(source) == []


@pytest.mark.parametrize("case", _NO_MESHES, ids=lambda case: case.stem)
def test_a_case_is_the_same_robot(case: Path) -> None:
    assert differences(case) == []


@pytest.fixture(scope="module")
def meshes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a mesh that is neither convex nor seen whole from its center, in three formats."""
    folder = tmp_path_factory.mktemp("meshes")
    parts = [trimesh.creation.box((0.4, 0.1, 0.1)), trimesh.creation.box((0.1, 0.1, 0.5))]
    parts[1].apply_translation((0.25, 0.02, 0.2))
    both = trimesh.util.concatenate(parts)
    both.export(folder / "part.stl")
    both.export(folder / "part.obj")
    counts = struct.pack("<4i", len(both.vertices), 0, 0, len(both.faces))
    (folder / "part.msh").write_bytes(
        counts + both.vertices.astype("<f4").tobytes() + both.faces.astype("<i4").tobytes()
    )
    return folder


@pytest.mark.parametrize("inertia", ["legacy", "exact", "convex", "shell"])
@pytest.mark.parametrize("kind", ["stl", "obj", "msh"])
def test_the_mass_of_a_mesh_is_that_of_mujoco(meshes: Path, kind: str, inertia: str) -> None:
    source = meshes / f"{kind}_{inertia}.xml"
    placed = 'scale="1 2 0.5" refpos="0.1 0.2 0.3"' if inertia == "exact" else 'refquat="0.8 0.6 0 0"'
    source.write_text(
        f'''<mujoco><asset><mesh name="m" file="part.{kind}" inertia="{inertia}" {placed}/></asset><worldbody>
        <body name="a"><freejoint/><geom type="mesh" mesh="m" pos="1 2 3" quat="0.6 0 0.8 0" density="300"/></body>
        <body name="b" pos="1 0 0"><joint/><geom type="mesh" mesh="m" mass="2"/><geom size="0.1"/></body>
        </worldbody></mujoco>'''
    )
    assert differences(source) == []
