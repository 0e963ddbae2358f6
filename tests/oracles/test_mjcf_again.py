"""A file of MJCF that was read and written as SDF is the same model again where that SDF is written as MJCF."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import twinform

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")

_FILE = """
<mujoco model="rig">
  <compiler angle="radian" autolimits="false"/>
  <option timestep="0.004" gravity="0 0 -3" integrator="implicitfast"/>
  <asset>
    <material name="skin" rgba="1 0.5 0.25 1" specular="0.25" emission="0.5" reflectance="0.1"/>
    <material name="bone" rgba="0.5 0.5 0.5 1"/>
    <texture name="checks" type="2d" builtin="checker" width="8" height="8"/>
    <material name="tiles" texture="checks" texrepeat="4 4"/>
  </asset>
  <worldbody>
    <light name="sun" type="directional" dir="0.5 0 -1" diffuse="0.5 0.5 0.5"/>
    <light name="spot" pos="0 0 3" cutoff="30" exponent="4" attenuation="1 0.1 0"/>
    <camera name="chase" pos="0 -3 1" mode="targetbody" target="arm"/>
    <site name="origin" size="0.1"/>
    <geom name="floor" type="plane" size="5 5 0.1" material="tiles" friction="0.5 0.01 0.001"/>
    <body name="base" pos="0 0 1">
      <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
      <geom name="trunk" type="box" size="0.1 0.1 0.1" material="skin" priority="2" friction="0.25"/>
      <site name="imu" pos="0 0 0.1" group="1"/>
      <camera name="eye" pos="0.1 0 0" fovy="60"/>
      <camera name="wide" pos="0.1 0 0" fovy="80" resolution="64 48"/>
      <body name="arm" pos="0.2 0 0" gravcomp="1">
        <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
        <joint name="arm" type="hinge" axis="0 1 0" armature="0.1"/>
        <geom name="bone" type="capsule" size="0.05 0.1" material="bone" contype="2" conaffinity="4"/>
        <geom name="shell" type="sphere" size="0.07" material="bone" contype="0" conaffinity="0" group="1"/>
        <site name="tip" pos="0 0 -0.2"/>
        <body name="hand" pos="0.2 0 0">
          <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
          <joint name="wrist" type="slide" axis="0 0 1" range="-0.1 0.1" limited="true"/>
          <geom name="palm" type="sphere" size="0.05" rgba="0 1 0 0.5"/>
        </body>
      </body>
    </body>
    <body name="ball" pos="1 0 1">
      <freejoint name="loose"/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
      <geom name="ball" size="0.1" contype="1" conaffinity="0"/>
    </body>
  </worldbody>
  <contact>
    <exclude body1="base" body2="hand"/>
    <pair geom1="palm" geom2="floor" friction="0.5 0.25 0.01 0.001 0.001"/>
  </contact>
  <equality>
    <connect name="tie" body1="hand" body2="ball" anchor="0.1 0 0" solref="0.01 1"/>
  </equality>
  <tendon>
    <fixed name="cord"><joint joint="arm" coef="1"/><joint joint="wrist" coef="-2"/></fixed>
  </tendon>
  <actuator>
    <motor name="arm" joint="arm" gear="10"/>
    <position name="wrist" joint="wrist" kp="50" ctrllimited="true" ctrlrange="-0.1 0.1"/>
  </actuator>
  <sensor>
    <accelerometer name="acc" site="imu" noise="0.1"/>
    <gyro name="gyro" site="imu"/>
    <force name="force" site="tip"/>
    <touch name="touch" site="tip"/>
    <rangefinder name="range" site="tip" cutoff="3"/>
    <jointpos name="angle" joint="arm"/>
    <framepos name="where" objtype="body" objname="hand"/>
  </sensor>
</mujoco>
"""
_KINDS = ("body", "jnt", "geom", "site", "cam", "light", "mat", "sensor", "actuator", "eq", "tendon", "exclude", "pair")
_PREFIXES = {
    "geom": ("contype", "conaffinity", "condim", "priority", "friction", "type", "size", "pos", "quat"),
    "site": ("pos", "quat", "group", "size"),
    "cam": ("fovy", "resolution", "pos", "quat", "mode"),
    "light": ("dir", "pos", "diffuse", "specular", "attenuation", "cutoff", "exponent", "castshadow", "type"),
    "body": ("gravcomp", "pos", "quat", "mass"),
    "jnt": ("type", "axis", "range", "limited"),
    "mat": ("specular", "emission", "reflectance", "texrepeat"),
    "sensor": ("type", "noise", "cutoff", "objtype"),
    "actuator": ("gainprm", "biasprm", "gear", "ctrlrange"),
    "eq": ("type", "data", "solref"),
    "pair": ("friction",),
}


def _pairs(first: Any, second: Any, kind: str) -> Iterator[tuple[int, int]]:
    """Yield the indices of parts of one name, or of one place where they have none."""
    type_ = {"jnt": "joint", "mat": "material", "cam": "camera", "eq": "equality"}.get(kind, kind)
    object_ = getattr(mujoco.mjtObj, f"mjOBJ_{type_.upper()}")
    names = [mujoco.mj_id2name(second, object_, index) for index in range(_count(second, kind))]
    for index in range(_count(first, kind)):
        name = mujoco.mj_id2name(first, object_, index)
        found = [place for place, each in enumerate(names) if each and (each == name or each.endswith(f"::{name}"))]
        yield index, found[0] if found else index


def _count(model: Any, kind: str) -> int:
    return getattr(model, {"actuator": "nu", "jnt": "njnt"}.get(kind, f"n{kind}"))


@pytest.fixture(scope="module")
def models(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, Any]:
    folder = tmp_path_factory.mktemp("again")
    source, between = folder / "rig.xml", folder / "rig.sdf"
    source.write_text(_FILE)
    between.write_text(twinform.convert(source, to="sdf").text)
    again = twinform.convert(between, to="mjcf").text
    Path(folder / "again.xml").write_text(again)
    return mujoco.MjModel.from_xml_string(_FILE), mujoco.MjModel.from_xml_string(again)


@pytest.mark.parametrize("kind", _KINDS)
def test_it_has_as_many_parts_as_before(models: tuple[Any, Any], kind: str) -> None:
    first, second = models
    assert _count(second, kind) == _count(first, kind)


@pytest.mark.parametrize(("kind", "field"), [(kind, each) for kind, fields in _PREFIXES.items() for each in fields])
def test_its_parts_have_the_numbers_that_they_had(models: tuple[Any, Any], kind: str, field: str) -> None:
    first, second = models
    for index, other in _pairs(first, second, kind):
        before, after = (
            np.array(getattr(model, f"{kind}_{field}")[place], dtype=float)
            for model, place in ((first, index), (second, other))
        )
        opposite = -after if field == "quat" else after
        assert np.allclose(before, after, atol=1e-9) or np.allclose(before, opposite, atol=1e-9), (index, before, after)


def test_its_settings_are_those_that_it_had(models: tuple[Any, Any]) -> None:
    first, second = (model.opt for model in models)
    assert (first.timestep, first.integrator) == (second.timestep, second.integrator)
    assert np.allclose(first.gravity, second.gravity)
