"""What falls, slides down a slope and comes to rest does so in MuJoCo as in DART, which has the SDF it was written of.

Contacts of MuJoCo are soft, so that links rest some millimeters deeper.
"""

import math
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.engines.gazebo import MISSING, Outcome, Settings, available, simulate
from testbed.mjcf.driven import Setup, driven, prepared

mujoco: Any = pytest.importorskip("mujoco")
pytestmark = pytest.mark.skipif(not available(), reason=MISSING)

_SECONDS = 2.0
_STEP = 0.001
_DEEPER = 0.003
_INERTIAL = "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
_GROUND = (
    "<model name='ground'><static>true</static><link name='link'><collision name='c'><geometry><plane>"
    "<size>100 100</size></plane></geometry></collision></link></model>"
)


def _link(name: str, shape: str, pose: str = "0 0 0 0 0 0", mu: float | None = None) -> str:
    friction = f"<ode><mu>{mu}</mu><mu2>{mu}</mu2></ode>" if mu is not None else ""
    surface = f"<surface><friction>{friction}</friction></surface>"
    collision = f"<collision name='c'><geometry>{shape}</geometry>{surface}</collision>"
    return f"<link name='{name}'><pose>{pose}</pose>{_INERTIAL}{collision}</link>"


def _both(world: str, tmp_path: Path) -> tuple[dict[str, tuple[float, ...]], dict[str, tuple[float, ...]]]:
    """Where the links of a world are in the end, in DART and in MuJoCo."""
    source = tmp_path / "source.sdf"
    physics = f"<physics type='dart'><max_step_size>{_STEP}</max_step_size></physics>"
    source.write_text(f"<sdf version='1.9'><world name='w'>{physics}{world}</world></sdf>")
    steps = round(_SECONDS / _STEP)
    in_dart = simulate([source], settings=Settings(steps=steps, dt=_STEP))[source.resolve()]
    assert in_dart.outcome is Outcome.DONE
    model = mujoco.MjModel.from_xml_string(twinform.convert(source, to="mjcf").text)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, steps)
    mujoco.mj_kinematics(model, data)  # a step leaves the poses of bodies where they were before it
    ends = {name: state.pose[:3] for name, state in in_dart.moments[-1].links.items() if not name.startswith("ground")}
    assert ends
    return ends, {name: tuple(data.body(name).xpos) for name in ends}


@pytest.mark.parametrize(
    "shape",
    [
        "<box><size>0.4 0.3 0.2</size></box>",
        "<sphere><radius>0.2</radius></sphere>",
        "<cylinder><radius>0.2</radius><length>0.3</length></cylinder>",
    ],
)
def test_a_shape_falls_and_comes_to_rest_where_it_does_in_dart(tmp_path: Path, shape: str) -> None:
    model = f"<model name='thing'><pose>0 0 0.5 0 0 0</pose>{_link('link', shape)}</model>"
    dart, made = _both(_GROUND + model, tmp_path)
    assert made["thing::link"] == pytest.approx(dart["thing::link"], abs=_DEEPER)


def test_an_arm_that_cannot_touch_itself_folds_as_it_does_in_dart(tmp_path: Path) -> None:
    ball = "<sphere><radius>0.15</radius></sphere>"
    links = "".join(_link(f"l{index}", ball, f"{0.2 * index} 0 0 0 0 0") for index in range(4))
    axis = "<axis><xyz>0 1 0</xyz><limit><lower>-0.2</lower><upper>0.2</upper></limit></axis>"
    joints = "".join(
        f"<joint name='j{index}' type='revolute'><parent>l{index}</parent><child>l{index + 1}</child>{axis}</joint>"
        for index in range(3)
    )
    dart, made = _both(f"{_GROUND}<model name='arm'><pose>0 0 0.3 0 0 0</pose>{links}{joints}</model>", tmp_path)
    for name, place in dart.items():
        assert made[name] == pytest.approx(place, abs=2 * _DEEPER)


# tan(0.3) is 0.31: with less friction than that, a box slides. DART lets one without any friction fall through a plane.
@pytest.mark.parametrize("mu", [0.02, 0.1, 0.2, 0.6])
def test_a_box_slides_down_a_slope_as_far_as_in_dart(tmp_path: Path, mu: float) -> None:
    tilt = 0.3
    slope = _GROUND.replace("<link name='link'>", f"<pose>0 0 0 0 {tilt} 0</pose><link name='link'>")
    box = _link("link", "<box><size>0.4 0.4 0.1</size></box>", mu=mu)
    height = 0.0501
    start = f"{height * math.sin(tilt)} 0 {height * math.cos(tilt)} 0 {tilt} 0"
    dart, made = _both(f"{slope}<model name='box'><pose>{start}</pose>{box}</model>", tmp_path)
    expected = 0.5 * 9.8 * max(0.0, math.sin(tilt) - mu * math.cos(tilt)) * _SECONDS**2
    for place in (made["box::link"], dart["box::link"]):
        assert math.hypot(place[0] - height * math.sin(tilt), place[2] - height * math.cos(tilt)) == pytest.approx(
            expected, rel=0.03, abs=0.02
        )


def _joint(name: str, parent: str, child: str, more: str = "", kind: str = "revolute", xyz: str = "0 1 0") -> str:
    axis = f"<axis><xyz>{xyz}</xyz><limit><effort>99</effort></limit>{more}</axis>"
    return f"<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{axis}</joint>"


_SPRING = "<dynamics><spring_stiffness>200</spring_stiffness><damping>5</damping></dynamics>"
_ARM = f"""<sdf version='1.9'><model name='arm'>
  <joint name='mount' type='fixed'><parent>world</parent><child>base</child></joint>
  <link name='base'>{_INERTIAL}</link>
  <link name='upper'><pose>0 0 0.1 0 0 0</pose>{_INERTIAL}</link>
  <link name='lower'><pose>0.4 0 0.1 0 0 0</pose>{_INERTIAL}</link>
  {_joint("lift", "base", "upper", _SPRING, "prismatic", "0 0 1")}
  {_joint("elbow", "upper", "lower", "<dynamics><damping>0.2</damping></dynamics>")}
</model></sdf>"""
_BALL = "<sphere><radius>0.15</radius></sphere>"
_PLACES = {"a": "0.3 0.3", "b": "0.3 -0.3", "c": "-0.3 0.3", "d": "-0.3 -0.3"}
_ROVER = f"""<sdf version='1.9'><model name='rover'><pose>0 0 0.3 0 0 0</pose>
  {_link("body", "<box><size>0.8 0.4 0.1</size></box>")}
  {"".join(_link(name, _BALL, f"{place} -0.1 0 0 0") for name, place in _PLACES.items())}
  {"".join(_joint(f"to_{name}", "body", name) for name in _PLACES)}
</model></sdf>"""


# Springs and damping are integrated otherwise: in DART a fourth of the step changes the end by 0.4 mm.
@pytest.mark.parametrize(
    ("robot", "on_ground", "most"), [(_ARM, False, 1e-3), (_ROVER, False, 1e-6), (_ROVER, True, _DEEPER)]
)
def test_a_robot_that_is_driven_ends_where_it_does_in_dart(
    tmp_path: Path, robot: str, on_ground: bool, most: float
) -> None:
    ends = driven(prepared(robot, tmp_path / "robot.sdf", on_ground=on_ground))
    assert ends.way > 10 * most
    assert ends.apart <= most


def test_a_body_that_hangs_below_the_ground_falls_alike_and_then_goes_by_contacts(tmp_path: Path) -> None:
    # The mass is 0.7 m beside the only shape, so that it tips over an edge, and swings below the plane.
    collision = "<collision name='c'><pose>0 0.7 0 0.3 0.4 0.5</pose><geometry><box><size>0.1 0.2 0.4</size></box>"
    body = f"<link name='link'>{_INERTIAL}{collision}</geometry></collision></link>"
    file = tmp_path / "body.sdf"
    file.write_text(f"<sdf version='1.9'><model name='body'>{body}</model></sdf>")
    setup = Setup(file, twinform.convert(file, to="mjcf").text, {}, -0.5, ())
    assert driven(setup, 0.2).apart < 1e-9
    ends = driven(setup)
    assert max(ends.mujoco, ends.soft) > ends.apart / 3
