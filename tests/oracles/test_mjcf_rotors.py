"""The inertia of rotors that Drake adds to joints of URDF and SDF is in the mass matrix of MuJoCo, and comes home."""

import importlib
from pathlib import Path
from typing import Any

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.testing import oracles

mujoco: Any = pytest.importorskip("mujoco")

_SDF = Path(__file__).parents[1] / "cases/to_mjcf/rotors.sdf"
_URDF = f"""
<robot name="arm" xmlns:drake="http://drake.mit.edu">
  <link name="base"/>
  <link name="hand">{INERTIAL}</link>
  <joint name="wrist" type="continuous"><parent link="base"/><child link="hand"/><axis xyz="0 0 1"/></joint>
  <transmission name="t">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="wrist"/>
    <actuator name="m"><drake:rotor_inertia value="0.01"/><drake:gear_ratio value="10"/></actuator>
  </transmission>
</robot>
"""
_FILES = {"sdf": _SDF.read_text(), "urdf": _URDF}


def _armatures(text: str) -> dict[str, float]:
    model = mujoco.MjModel.from_xml_string(text)
    joints = (model.joint(index) for index in range(model.njnt))
    return {each.name: float(model.dof_armature[each.dofadr[0]]) for each in joints if each.name}


@pytest.mark.parametrize("kind", sorted(_FILES))
def test_rotors_weigh_what_drake_gives_them(kind: str, tmp_path: Path) -> None:
    if not oracles.available("drake"):
        pytest.skip("Drake is not installed")
    path = tmp_path / f"arm.{kind}"
    path.write_text(_FILES[kind])
    plant: Any = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.0)
    importlib.import_module("pydrake.multibody.parsing").Parser(plant).AddModels(str(path))
    actuators = [plant.get_joint_actuator(each) for each in plant.GetJointActuatorIndices()]
    expected = {
        each.joint().name(): each.default_rotor_inertia() * each.default_gear_ratio() ** 2 for each in actuators
    }
    made = _armatures(twinform.convert(path, to="mjcf").text)
    assert any(made.values())
    assert {name: made[name] for name in expected} == pytest.approx(expected)


@pytest.mark.parametrize(("kind", "before", "after"), [("sdf", "1.44", "2.88"), ("urdf", "1", "2")])
def test_an_armature_comes_home_as_a_rotor(kind: str, before: str, after: str) -> None:
    to: Any = kind
    made = twinform.convert(_FILES[kind].encode(), to="mjcf").text
    back = twinform.convert(made.encode(), to=to).text
    assert "armature" not in back
    assert back.count("0.01") == 1
    edited = made.replace(f'armature="{before}"', f'armature="{after}"')
    assert edited != made
    home = twinform.convert(edited.encode(), to=to).text
    assert home == back.replace("0.01", "0.02")
