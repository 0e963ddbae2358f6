"""What MuJoCo does with sensors, cameras, lights, contacts, loops and worlds of SDF that are written as MJCF."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import twinform

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")

_INERTIAL = "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
_GRAVITY = 9.8
_GROUND = (
    "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry><plane/></geometry>"
    "</collision></link></model>"
)
_FIXED = "<joint name='hold' type='fixed'><parent>world</parent><child>base</child></joint>"


def _model(content: str, name: str = "m", attributes: str = "") -> str:
    return f"<model name='{name}' {attributes}>{content}</model>"


def _world(content: str) -> str:
    return f"<world name='w'>{content}</world>"


def _loaded(content: str, tmp_path: Path) -> tuple[Any, Any]:
    """The model and the state of MuJoCo for what stands in an SDF file."""
    source = tmp_path / "source.sdf"
    source.write_text(f"<sdf version='1.12'>{content}</sdf>")
    text = twinform.convert(source, to="mjcf").text
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def _run(model: Any, data: Any, seconds: float) -> None:
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)


def _link(name: str, content: str = "", pose: str = "0 0 0 0 0 0") -> str:
    return f"<link name='{name}'><pose>{pose}</pose>{_INERTIAL}{content}</link>"


def _ball(name: str, radius: float = 0.1, surface: str = "", pose: str = "0 0 0 0 0 0") -> str:
    geometry = f"<geometry><sphere><radius>{radius}</radius></sphere></geometry>"
    return f"<collision name='{name}'><pose>{pose}</pose>{geometry}{surface}</collision>"


def test_an_imu_at_rest_reads_gravity_upward_in_its_own_axes(tmp_path: Path) -> None:
    sensor = "<sensor name='imu' type='imu'><pose>0.1 0 0 1.5707963267948966 0 0</pose></sensor>"
    _, data = _loaded(_world(_model(_link("base", sensor) + _FIXED)), tmp_path)
    assert data.sensor("m::imu_accelerometer").data == pytest.approx([0, _GRAVITY, 0], abs=1e-6)
    assert data.sensor("m::imu_gyro").data == pytest.approx([0, 0, 0], abs=1e-9)
    half = math.sqrt(0.5)
    assert data.sensor("m::imu_framequat").data == pytest.approx([half, half, 0, 0], abs=1e-9)


def _wrench(words: str, pose: str = "") -> str:
    sensor = f"<sensor name='ft' type='force_torque'>{pose}<force_torque>{words}</force_torque></sensor>"
    joint = f"<joint name='j' type='fixed'><parent>base</parent><child>tip</child>{sensor}</joint>"
    return _world(_model(_link("base") + _link("tip", pose="0.5 0 0 0 0 1.5707963267948966") + joint + _FIXED))


def test_a_force_torque_sensor_reads_what_the_parent_does_to_the_child(tmp_path: Path) -> None:
    words = "<frame>child</frame><measure_direction>parent_to_child</measure_direction>"
    _, data = _loaded(_wrench(words), tmp_path)
    assert data.sensor("m::ft_force").data == pytest.approx([0, 0, _GRAVITY], abs=1e-6)


def test_a_force_torque_sensor_with_the_other_sign_is_in_the_ledger(tmp_path: Path) -> None:
    for words, count in (("<measure_direction>parent_to_child</measure_direction>", 0), ("", 1)):
        source = tmp_path / "source.sdf"
        source.write_text(f"<sdf version='1.12'>{_wrench(words)}</sdf>")
        entries = twinform.convert(source, to="mjcf").ledger.entries
        assert sum("opposite sign" in each.message for each in entries) == count


@pytest.mark.parametrize(
    ("frame", "torque"),
    # the center of mass is 0.3 m along x of the base from the sensor, which is 0.3 m along -y of the turned child
    [("child", [-0.3 * _GRAVITY, 0, 0]), ("parent", [0, -0.3 * _GRAVITY, 0]), ("sensor", [-0.3 * _GRAVITY, 0, 0])],
)
def test_a_torque_is_about_the_origin_of_the_sensor_in_the_axes_that_it_names(
    tmp_path: Path, frame: str, torque: list[float]
) -> None:
    words = f"<frame>{frame}</frame><measure_direction>parent_to_child</measure_direction>"
    _, data = _loaded(_wrench(words, "<pose>0 0.3 0 0 0 0</pose>"), tmp_path)
    assert data.sensor("m::ft_torque").data == pytest.approx(torque, abs=1e-6)


def test_a_camera_looks_along_x_with_z_up(tmp_path: Path) -> None:
    camera = (
        "<sensor name='eye' type='camera'><pose>0 0 1 0 0 1.5707963267948966</pose><camera>"
        "<horizontal_fov>1.2</horizontal_fov><image><width>640</width><height>480</height></image></camera></sensor>"
    )
    model, data = _loaded(_model(_link("base", camera) + _FIXED), tmp_path)
    right, up, back = data.cam_xmat[0].reshape(3, 3).T
    assert -back == pytest.approx([0, 1, 0], abs=1e-9)
    assert up == pytest.approx([0, 0, 1], abs=1e-9)
    assert right == pytest.approx([1, 0, 0], abs=1e-9)
    assert data.cam_xpos[0] == pytest.approx([0, 0, 1])
    assert math.tan(math.radians(model.cam_fovy[0]) / 2) * 640 / 480 == pytest.approx(math.tan(0.6))
    assert list(model.cam_resolution[0]) == [640, 480]


def test_rays_of_a_lidar_meet_a_wall_where_they_should(tmp_path: Path) -> None:
    lidar = (
        "<sensor name='scan' type='gpu_lidar'><pose>0 0 1 0 0 0</pose><lidar><scan><horizontal><samples>3</samples>"
        "<min_angle>-0.5</min_angle><max_angle>0.7</max_angle></horizontal><vertical><samples>2</samples>"
        "<min_angle>0</min_angle><max_angle>0.2</max_angle></vertical></scan><range><max>50</max></range></lidar></sensor>"
    )
    wall = (
        "<model name='wall'><static>true</static><pose>3.5 0 0 0 0 0</pose><link name='l'><collision name='c'>"
        "<geometry><box><size>1 100 100</size></box></geometry></collision></link></model>"
    )
    _, data = _loaded(_world(_model(_link("base", lidar) + _FIXED) + wall), tmp_path)
    angles = [(up, left) for up in (0.0, 0.2) for left in (-0.5, 0.1, 0.7)]
    expected = [3 / (math.cos(up) * math.cos(left)) for up, left in angles]
    assert [data.sensor(f"m::scan_ray_{index}").data[0] for index in range(6)] == pytest.approx(expected, rel=1e-9)


def test_a_contact_sensor_counts_contacts_of_its_collision(tmp_path: Path) -> None:
    sensor = "<sensor name='bump' type='contact'><contact><collision>c</collision></contact></sensor>"
    model, data = _loaded(_world(_GROUND + _model(_link("base", _ball("c") + sensor, "0 0 0.1 0 0 0"))), tmp_path)
    _run(model, data, 1.0)
    found, *force = data.sensor("m::bump").data
    assert found == 1
    assert np.linalg.norm(force) == pytest.approx(_GRAVITY, rel=0.01)


def test_a_spot_has_half_of_its_outer_angle_and_shines_where_it_did(tmp_path: Path) -> None:
    light = (
        "<light name='lamp' type='spot'><pose>0 0 2 0 1.5707963267948966 0</pose><spot><inner_angle>0.2</inner_angle>"
        "<outer_angle>1</outer_angle><falloff>3</falloff></spot><attenuation><linear>0.25</linear></attenuation></light>"
    )
    model, _ = _loaded(_world(light), tmp_path)
    assert model.light_dir[0] == pytest.approx([-1, 0, 0], abs=1e-9)
    assert model.light_cutoff[0] == pytest.approx(math.degrees(0.5))
    assert model.light_exponent[0] == pytest.approx(3)
    assert list(model.light_attenuation[0]) == pytest.approx([1, 0.25, 0])


def test_a_world_has_the_step_and_the_gravity_of_sdf(tmp_path: Path) -> None:
    model, _ = _loaded(_world("<physics type='dart'><max_step_size>0.004</max_step_size></physics>"), tmp_path)
    assert model.opt.timestep == 0.004
    assert list(model.opt.gravity) == [0, 0, -_GRAVITY]
    model, _ = _loaded(_world("<gravity>0 0 -1.6</gravity><magnetic_field>1 2 3</magnetic_field>"), tmp_path)
    assert model.opt.timestep == 0.001
    assert list(model.opt.gravity) == [0, 0, -1.6]
    assert list(model.opt.magnetic) == [1, 2, 3]


def test_gravity_does_not_act_on_a_link_without_gravity(tmp_path: Path) -> None:
    model, data = _loaded(_world(_model(_link("base", "<gravity>false</gravity>"))), tmp_path)
    _run(model, data, 0.5)
    assert data.body("m::base").xpos == pytest.approx([0, 0, 0], abs=1e-9)


def _arm(attributes: str = "", surface: str = "") -> str:
    """Four balls in a row, each on a hinge of the one before, which can meet each other."""
    links = "".join(_link(f"l{i}", _ball("c", 0.12, surface), f"{0.2 * i} 0 0 0 0 0") for i in range(5))
    joints = "".join(
        f"<joint name='j{i}' type='revolute'><parent>l{i}</parent><child>l{i + 1}</child>"
        "<axis><xyz>0 1 0</xyz></axis></joint>"
        for i in range(4)
    )
    return _model(f"{attributes}{links}{joints}", "arm")


def _own_contacts(model: Any, data: Any) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies of the arm that touch."""
    for contact in data.contact[: data.ncon]:
        bodies = [model.body(int(model.geom_bodyid[geom])).name for geom in contact.geom]
        if all("l" in each and "ground" not in each for each in bodies):
            yield bodies[0], bodies[1]


def _poses(model: Any, data: Any, count: int = 200) -> Iterator[None]:
    random = np.random.default_rng(1)
    for _ in range(count):
        data.qpos[7:] = random.uniform(-math.pi, math.pi, model.nq - 7)
        mujoco.mj_forward(model, data)
        yield


@pytest.mark.parametrize("surface", ["", "<surface><contact><collide_bitmask>6</collide_bitmask></contact></surface>"])
def test_a_model_without_self_collision_touches_the_ground_and_not_itself(tmp_path: Path, surface: str) -> None:
    model, data = _loaded(_world(_GROUND + _arm(surface=surface)), tmp_path)
    for _ in _poses(model, data):
        assert not list(_own_contacts(model, data))
    data.qpos[:] = model.qpos0
    mujoco.mj_forward(model, data)
    assert data.ncon == 5


def test_links_of_a_self_colliding_model_touch_unless_a_joint_connects_them(tmp_path: Path) -> None:
    model, data = _loaded(_world(_GROUND + _arm("<self_collide>true</self_collide>")), tmp_path)
    pairs = {pair for _ in _poses(model, data) for pair in _own_contacts(model, data)}
    distances = {abs(int(one[-1]) - int(other[-1])) for one, other in pairs}
    assert distances == {2, 3, 4}


def test_a_child_of_a_fixed_base_does_not_touch_it(tmp_path: Path) -> None:
    held = (
        "<self_collide>true</self_collide><joint name='w' type='fixed'><parent>world</parent><child>l0</child></joint>"
    )
    model, data = _loaded(_arm(held), tmp_path)
    assert not list(_own_contacts(model, data))  # all others are too far from each other when drawn
    assert model.nexclude == 1


def test_two_models_without_self_collision_touch_each_other(tmp_path: Path) -> None:
    other = _arm().replace("'arm'", "'brm'")
    model, data = _loaded(_world(_arm() + other), tmp_path)
    assert data.ncon >= 5
    assert {
        tuple(sorted({model.body(int(model.geom_bodyid[geom])).name[0] for geom in each.geom})) for each in data.contact
    } == {("a", "b")}


@pytest.mark.parametrize(
    ("first", "second", "expected"), [(0.2, None, 0.2), (None, 0.3, 0.3), (0.5, 0.2, 0.2), (3, 2, 2)]
)
def test_the_lesser_of_two_frictions_counts(
    tmp_path: Path, first: float | None, second: float | None, expected: float
) -> None:
    def surface(mu: float | None) -> str:
        return "" if mu is None else f"<surface><friction><ode><mu>{mu}</mu></ode></friction></surface>"

    ground = _GROUND.replace("</geometry>", f"</geometry>{surface(first)}")
    _, data = _loaded(_world(ground + _model(_link("base", _ball("c", surface=surface(second))))), tmp_path)
    assert data.ncon == 1
    assert data.contact[0].friction[0] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("friction", "condim", "lengths"),
    [
        (
            "<torsional><coefficient>0.5</coefficient><patch_radius>0.002</patch_radius></torsional>",
            4,
            (3 * np.pi / 16e3, 0),
        ),
        ("<torsional><patch_radius>0.2</patch_radius></torsional>", 4, (0.6 * np.pi / 16, 0)),
        ("<bullet><rolling_friction>0.02</rolling_friction></bullet>", 6, (0, 0.02)),
        ("<torsional><use_patch_radius>false</use_patch_radius><patch_radius>1</patch_radius></torsional>", 3, None),
    ],
)
def test_a_ball_turns_and_rolls_with_the_friction_of_sdf_on_a_usual_floor(
    tmp_path: Path, friction: str, condim: int, lengths: tuple[float, float] | None
) -> None:
    ball = _ball("c", surface=f"<surface><friction>{friction}</friction></surface>")
    _, data = _loaded(_world(_GROUND + _model(_link("base", ball))), tmp_path)
    assert data.ncon == 1
    contact = data.contact[0]
    assert contact.dim == condim
    if lengths is not None:  # MuJoCo has no friction below 1e-5
        torsional, rolling = (max(each, 1e-5) for each in lengths)
        assert contact.friction[2] == pytest.approx(torsional, rel=1e-9)
        assert condim == 4 or contact.friction[3] == pytest.approx(rolling)


_BAR = _INERTIAL.replace("<inertial>", "<inertial><pose>{0}</pose>")


def _four_bars(kind: str) -> str:
    axis = "<axis><xyz>0 1 0</xyz></axis>"
    links = "".join(
        f"<link name='{name}'><pose>{pose}</pose>{_BAR.format(center)}</link>"
        for name, pose, center in (
            ("base", "0 0 0 0 0 0", "0 0 0 0 0 0"),
            ("a", "0 0 0 0 0 0", "0 0 0.25 0 0 0"),
            ("b", "0 0 0.5 0 0 0", "0.5 0 0 0 0 0"),
            ("c", "1 0 0 0 0 0", "0 0 0.25 0 0 0"),
        )
    )
    joints = "".join(
        f"<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child>{axis}</joint>"
        for name, parent, child in (("ja", "base", "a"), ("jb", "a", "b"), ("jc", "base", "c"))
    )
    closing = (
        f"<joint name='jd' type='{kind}'><pose relative_to='b'>1 0 0 0 0 0</pose><parent>b</parent><child>c</child>"
        f"{axis if kind == 'revolute' else ''}</joint>"
    )
    return _model(links + joints + closing + _FIXED)


@pytest.mark.parametrize("kind", ["revolute", "ball"])
def test_a_four_bar_linkage_stays_closed_while_it_moves(tmp_path: Path, kind: str) -> None:
    model, data = _loaded(_four_bars(kind), tmp_path)
    data.qvel[:] = [1.0, -1.0, 1.0]
    turned = 0.0
    for _ in range(1000):
        mujoco.mj_step(model, data)
        first, last = data.body("b"), data.body("c")
        end = first.xpos + first.xmat.reshape(3, 3) @ [1, 0, 0]
        top = last.xpos + last.xmat.reshape(3, 3) @ [0, 0, 0.5]
        assert np.linalg.norm(end - top) < 0.01
        turned = max(turned, abs(data.joint("ja").qpos[0]))
    assert turned > 0.5


# The first joint is a ball, which leaves three freedoms between the two links. Another ball beside it leaves one.
@pytest.mark.parametrize(("kind", "rows", "rank"), [("revolute", 6, 3), ("ball", 3, 2)])
def test_a_second_joint_takes_the_freedoms_of_its_type(tmp_path: Path, kind: str, rows: int, rank: int) -> None:
    joints = "".join(
        f"<joint name='{name}' type='{each}'><pose>{pose}</pose><parent>a</parent><child>b</child></joint>"
        for name, each, pose in (("first", "ball", "0 0 0 0 0 0"), ("second", kind, "0 0.3 0 0 0 0"))
    )
    model, data = _loaded(_model(_link("a") + _link("b", pose="0 0 0.2 0 0 0") + joints), tmp_path)
    assert data.ne == rows
    jacobian = np.zeros((data.nefc, model.nv))
    for row in range(data.nefc):
        force = np.zeros(data.nefc)
        force[row] = 1.0
        mujoco.mj_mulJacTVec(model, data, jacobian[row], force)
    assert np.linalg.matrix_rank(jacobian, tol=1e-9) == rank


_MOTORS = (
    "<plugin filename='gz-sim-joint-position-controller-system' name='gz::sim::systems::JointPositionController'>"
    "<joint_name>turn</joint_name></plugin>"
    "<plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>"
    "<joint_name>roll</joint_name></plugin>"
)


def test_actuators_move_joints_to_what_is_commanded(tmp_path: Path) -> None:
    limit = "<limit><lower>-2</lower><upper>2</upper><effort>20</effort><velocity>5</velocity></limit>"
    joints = "".join(
        f"<joint name='{name}' type='revolute'><parent>base</parent><child>{child}</child>"
        f"<axis><xyz>0 0 1</xyz>{each}</axis></joint>"
        for name, child, each in (
            ("turn", "a", limit),
            ("roll", "b", limit.replace("-2", "-1e16").replace("2<", "1e16<")),
        )
    )
    source = tmp_path / "source.sdf"
    robot = _model(_link("base") + _link("a") + _link("b", pose="0 0 1 0 0 0") + joints + _FIXED + _MOTORS, "robot")
    source.write_text(f"<sdf version='1.12'>{_world(robot)}</sdf>")
    model = mujoco.MjModel.from_xml_string(twinform.convert(source, to="mjcf", passes="add-actuators").text)
    data = mujoco.MjData(model)
    data.actuator("turn").ctrl[0] = 0.7
    data.actuator("roll").ctrl[0] = 3.0
    _run(model, data, 2.0)
    assert data.joint("robot::turn").qpos[0] == pytest.approx(0.7, abs=1e-3)
    assert data.joint("robot::roll").qvel[0] == pytest.approx(3.0, rel=1e-2)
    data.actuator("turn").ctrl[0] = 9.0
    _run(model, data, 2.0)
    assert data.joint("robot::turn").qpos[0] == pytest.approx(2.0, abs=1e-2)


def test_a_joint_between_frames_of_one_link_holds_nothing(tmp_path: Path) -> None:
    frames = "<frame name='f' attached_to='inner::base'/><frame name='g' attached_to='inner::base'/>"
    joint = "<joint name='j' type='revolute'><parent>f</parent><child>g</child><axis><xyz>0 0 1</xyz></axis></joint>"
    inner = _model(_model(_link("base"), "inner") + frames + joint, "middle")
    model, _ = _loaded(_model(inner), tmp_path)
    assert model.neq == 0
