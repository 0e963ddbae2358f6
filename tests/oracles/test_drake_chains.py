"""Drake moves a joint of SDF and the chain that it becomes in URDF alike."""

import importlib
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import twinform
from twinform.passes.carriers.token_mass import CHAIN_MASS
from twinform.testing.oracles.robot_comparison import IN_CHAINS

np: Any = pytest.importorskip("numpy")
pytest.importorskip("pydrake")

SDF = """<sdf version="1.10"><model name="m"><pose>0.3 0.1 0.2 0.1 0.3 0.2</pose>
<link name="a"><inertial><mass>1</mass></inertial></link>
<link name="b"><pose>1 0 1 0.1 0.2 0.4</pose><inertial><pose>0.1 0.2 0.3 0 0 0</pose><mass>2</mass></inertial></link>
<link name="c"><pose>2 0 1 0.1 0.2 0</pose></link>
<link name="d"><pose>3 0 1 0.1 -0.2 0.3</pose></link>
<joint name="u" type="universal"><pose>0 0 0.1 0.3 0 0.2</pose><parent>a</parent><child>b</child>
  <axis><xyz expressed_in="b">0 1 0</xyz></axis><axis2><xyz expressed_in="b">1 0 0</xyz></axis2></joint>
<joint name="s" type="screw"><pose>0.1 0 0 0.2 0.1 0</pose><parent>b</parent><child>c</child>
  {}<axis><xyz>0 0.6 0.8</xyz></axis></joint>
<joint name="w" type="ball"><pose>0.1 0 0 0.2 0.1 0</pose><parent>c</parent><child>d</child></joint>
</model></sdf>"""

PITCHES = {
    "<screw_thread_pitch>0.3</screw_thread_pitch>": 0.3 / math.tau,
    "<screw_thread_pitch>-0.3</screw_thread_pitch>": -0.3 / math.tau,
}
SAMPLES = 20


@pytest.mark.parametrize("pitch", PITCHES)
def test_universal_screw_and_ball_joints_move_as_their_chains_do(pitch: str):
    sdf = SDF.format(pitch)
    urdf = twinform.convert(sdf.encode(), to="urdf").text
    one, other = _plant(sdf, "sdf"), _plant(urdf, "urdf")
    for u, v, turn, roll, pitch_, yaw in np.random.default_rng(1).uniform(-1.2, 1.2, (SAMPLES, 6)):
        here = _centers(one, {"u": [u, v], "s": [turn], "w": [roll, pitch_, yaw]})
        chain = {"u_axis": u, "u": v, "s_slide": turn * PITCHES[pitch], "s": turn, "w_z": yaw, "w_y": pitch_, "w": roll}
        there = _centers(other, {name: [value] for name, value in chain.items()})
        for link in "bcd":  # the frames of the links are elsewhere, so the axes of their inertias are compared
            assert np.abs(here[link][0] - there[link][0]).max() < 1e-9
            assert np.abs(here[link][1] - there[link][1]).max() < 1e-9


def test_joints_of_drake_move_as_the_joints_of_sdf_that_they_become():
    urdf = (Path(__file__).parents[1] / "cases/convert/joints_of_drake.urdf").read_text()
    one, other = _plant(urdf, "urdf"), _plant(twinform.convert(urdf.encode(), to="sdf", sdf_version="1.10").text, "sdf")
    for ball, (u, v), turn, (x, y, yaw) in _samples(3, 2, 1, 3):
        joints = {"pin": ball, "cross": [u, v], "bolt": turn}
        here = _centers(one, {**joints, "table": [x, y, yaw]}, "bcde")
        there = _centers(other, {**joints, "table_x": [x], "table_y": [y], "table": [yaw]}, "bcde")
        for link in "bcde":
            assert np.abs(here[link][0] - there[link][0]).max() < 1e-9
            assert np.abs(here[link][1] - there[link][1]).max() < 1e-9


def _samples(*sizes: int) -> Iterator[list[Any]]:
    """Draw positions of joints with so many degrees of freedom."""
    random = np.random.default_rng(4)
    for _ in range(SAMPLES):
        yield [random.uniform(-1.2, 1.2, size) for size in sizes]


def test_a_chain_is_as_heavy_to_turn_as_its_universal_joint_but_for_the_links_between():
    sdf = SDF.format("")
    urdf = twinform.convert(sdf.encode(), to="urdf").text
    token = f'<mass value="{CHAIN_MASS:g}"/>'
    assert urdf.count(token) == len(["u", "s", "w", "w"])
    one, other = _plant(sdf, "sdf"), _plant(urdf, "urdf")
    bare = _plant(urdf.replace(token, '<mass value="1e-12"/>'), "urdf")
    for u, v in np.random.default_rng(2).uniform(-1.2, 1.2, (SAMPLES, 2)):
        here = _mass_matrix(one, {"u": [u, v]}, ["u"])
        there, without = (_mass_matrix(plant, {"u_axis": [u], "u": [v]}, ["u_axis", "u"]) for plant in (other, bare))
        assert np.abs(here - without).max() < 1e-9
        assert np.abs(here - there).max() < IN_CHAINS * np.abs(here).max()


def _mass_matrix(plant: Any, values: dict[str, list[float]], joints: list[str]) -> Any:
    """The part of the mass matrix that belongs to these joints."""
    context = _at(plant, values)
    found = [plant.GetJointByName(name) for name in joints]
    rows = [joint.velocity_start() + i for joint in found for i in range(joint.num_velocities())]
    return plant.CalcMassMatrix(context)[np.ix_(rows, rows)]


def _at(plant: Any, values: dict[str, list[float]]) -> Any:
    """A context with the joints at these positions."""
    context = plant.CreateDefaultContext()
    positions = plant.GetPositions(context)
    for name, value in values.items():
        start = plant.GetJointByName(name).position_start()
        positions[start : start + len(value)] = value
    plant.SetPositions(context, positions)
    return context


def _plant(text: str, kind: str) -> Any:
    plant = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.001)  # mimic asks for discrete time
    importlib.import_module("pydrake.multibody.parsing").Parser(plant).AddModelsFromString(text, kind)
    plant.Finalize()
    return plant


def _centers(plant: Any, values: dict[str, list[float]], links: str = "bcd") -> dict[str, tuple[Any, Any]]:
    """The center of mass of each link and its rotation since all joints stood at zero, both in the link `a`."""
    context, context_at_zero = _at(plant, values), plant.CreateDefaultContext()
    root = plant.GetBodyByName("a")
    frames = [plant.GetBodyByName(name) for name in links]
    return {body.name(): _center(plant, body, root, context, context_at_zero) for body in frames}


def _center(plant: Any, body: Any, root: Any, context: Any, at_zero: Any) -> tuple[Any, Any]:
    now, before = (_pose(plant, body, root, each) for each in (context, at_zero))
    center = now.multiply(body.CalcCenterOfMassInBodyFrame(context))
    return center, now.rotation().matrix() @ before.rotation().matrix().T


def _pose(plant: Any, body: Any, root: Any, context: Any) -> Any:
    return plant.EvalBodyPoseInWorld(context, root).inverse().multiply(plant.EvalBodyPoseInWorld(context, body))
