"""Command interfaces that are made of actuators mean what MuJoCo does with the control."""

from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import twinform

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")

_INERTIAL = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
_BODY = f'<body name="body_of_{{0}}">{_INERTIAL}<joint name="{{0}}" axis="0 0 1"/></body>'
_ACTUATORS = {
    "position": '<position {0} kp="40" gear="2" ctrlrange="-0.5 1"/>',
    "reversed": '<position {0} kp="40" gear="-2" ctrlrange="-0.5 1"/>',
    "velocity": '<velocity {0} kv="3" gear="4" ctrlrange="-4 4"/>',
    "motor": '<motor {0} gear="10" ctrlrange="-1 1"/>',
    "stiff": '<general {0} gainprm="20" biastype="affine" biasprm="0 -40 0" ctrlrange="-1 1"/>',
    "drag": '<general {0} gainprm="6" biastype="affine" biasprm="0 0 -3" ctrlrange="-1 1"/>',
    "torque": '<general {0} gainprm="6" gear="2" ctrlrange="-1 1"/>',
}
_JOINTS = "".join(_BODY.format(name) for name in _ACTUATORS)
_SECTION = "".join(text.format(f'name="{name}" joint="{name}"') for name, text in _ACTUATORS.items())
_BASE = f'<body name="base">{_INERTIAL}{_JOINTS}</body>'
_MODEL = f"<mujoco><worldbody>{_BASE}</worldbody><actuator>{_SECTION}</actuator></mujoco>"


@pytest.fixture(scope="module")
def urdf(tmp_path_factory: pytest.TempPathFactory) -> str:
    source = tmp_path_factory.mktemp("actuators") / "robot.xml"
    source.write_text(_MODEL)
    return twinform.convert(source, to="urdf", passes="ros2-control-from-actuators").text


@pytest.mark.parametrize("name", _ACTUATORS)
def test_the_ends_of_a_command_are_those_of_the_control(urdf: str, name: str) -> None:
    command = etree.fromstring(urdf.encode()).find(f".//ros2_control/joint[@name='{name}']/command_interface")
    assert command is not None
    ends = [float(each.text or "") for each in command]
    model = mujoco.MjModel.from_xml_string(_MODEL)
    data = mujoco.MjData(model)
    number = model.actuator(name).id
    controls = sorted(model.actuator_ctrlrange[number], reverse=bool(model.actuator_gear[number][0] < 0))
    for end, control in zip(ends, controls, strict=True):
        data.ctrl[number] = control
        values = {"position": data.qpos, "velocity": data.qvel}.get(command.get("name") or "")
        if values is not None:
            values[model.joint(name).id] = end
        mujoco.mj_forward(model, data)
        force = data.qfrc_actuator[model.joint(name).id]
        assert force == pytest.approx(end if values is None else 0.0, abs=1e-9)


def test_actuators_are_the_same_after_the_way_to_urdf_and_back(urdf: str, tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text(urdf)
    source, back = (mujoco.MjModel.from_xml_string(text) for text in (_MODEL, twinform.convert(file, to="mjcf").text))
    for field in ("actuator_gainprm", "actuator_biasprm", "actuator_gear", "actuator_ctrlrange", "actuator_forcerange"):
        assert np.array_equal(getattr(source, field), getattr(back, field)), field
