"""Rules: frame-elsewhere, frame-not-in-tf, no-joint-states, package-name."""

import math

import pytest

import twinform
from twinform.compiler import CompileError
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.packaging.kinds import build
from twinform.compiler.packaging.order import Built, Order, PackageDetails
from twinform.compiler.request import ConversionRequest
from twinform.ir.frames import FrameGraph
from twinform.ir.node import Vector3
from twinform.passes.framework.pipeline_text import parse_pipeline

from .ros2_robots import interfaces, joint, link, system

ROBOT = f'<robot name="r">{link("base")}{link("a")}{joint("j", "a")}</robot>'


def packaged(name: str = "robot", passes: str = "", text: str = ROBOT) -> Built:
    order = Order(
        source=text.encode(),
        source_name="robot.urdf",
        name=name,
        folder=name,
        conversion=ConversionRequest(to="urdf", passes=parse_pipeline(passes)),
        load_options=LoadOptions(),
        details=PackageDetails(description="A robot", maintainer="Ann", email="ann@example.org", license="MIT"),
    )
    return build(order, ("ros2",))


def urdf_of(built: Built) -> str:
    content = built.package.files["urdf/robot.urdf"]
    assert isinstance(content, bytes)
    return content.decode()


def rules(built: Built) -> list[str]:
    return [each.rule.name for each in built.diagnostics]


@pytest.mark.parametrize("name", ["ab", "robot2", "my_robot_description", "r2d2"])
def test_names_of_packages_are_taken(name: str) -> None:
    assert f"urdf/{name}.urdf" in packaged(name).package.files


@pytest.mark.parametrize(
    ("name", "suggested"),
    [
        ("My-Robot", "my_robot"),
        ("a", "a_robot"),
        ("R", "r_robot"),
        ("2wheels", "robot_2wheels"),
        ("a__b_", "a_b"),
        ('"; rm -rf ~', "rm_rf"),
        ("名", "robot"),
        ("a\nb", "a_b"),
    ],
)
def test_other_names_are_an_error_with_a_name_to_take(name: str, suggested: str) -> None:
    with pytest.raises(CompileError) as caught:
        packaged(name)
    (found,) = caught.value.diagnostics
    assert found.rule.name == "package-name"
    assert found.help
    assert suggested in found.help.split()


def test_a_robot_whose_joints_nobody_publishes_is_reported() -> None:
    assert rules(packaged()) == ["no-joint-states"]
    assert rules(packaged(passes="add-plugin{system=joint-state-publisher}")) == []


SENSOR = '<gazebo reference="base"><sensor name="eye" type="{}"><pose>{}</pose>{}</sensor></gazebo>'
FRAMES: dict[str, tuple[str, str, str, Vector3 | None]] = {
    "a sensor where its link is": ("imu", "0 0 0 0 0 0", "base", None),
    "a sensor elsewhere": ("gpu_lidar", "0.1 0 0.2 0 0 0", "eye_frame", (0.1, 0.0, 0.2)),
    "a camera": ("camera", "0 0 0 0 0 0", "eye_optical_frame", (0.0, 0.0, 0.0)),
    "a camera elsewhere": ("camera", "0.1 0 0.2 0 0.5 0", "eye_optical_frame", (0.1, 0.0, 0.2)),
    "a camera with clouds": ("rgbd_camera", "0.1 0 0.2 0 0.5 0", "eye_frame", (0.1, 0.0, 0.2)),
}


@pytest.mark.parametrize("case", FRAMES.values(), ids=FRAMES)
def test_a_sensor_without_a_frame_gets_one_where_it_is(case: tuple[str, str, str, Vector3 | None]) -> None:
    type_, pose, frame, at = case
    built = packaged(text=f'<robot name="r">{link("base")}{SENSOR.format(type_, pose, "")}</robot>')
    assert not [each for each in rules(built) if each.startswith("frame-")]
    urdf = twinform.loads(urdf_of(built)).models[0]
    assert f"<gz_frame_id>{frame}</gz_frame_id>" in urdf_of(built)
    assert [each.name for each in urdf.links] == ["base", *([frame] if at else [])]
    if at is not None:
        place = FrameGraph(urdf).pose(frame, "base")
        assert place.translation == pytest.approx(at)
        looks = place.rotate((0.0, 0.0, 1.0) if "optical" in frame else (1.0, 0.0, 0.0))
        pitch = float(pose.split()[4])
        assert looks == pytest.approx((math.cos(pitch), 0.0, -math.sin(pitch)))


def test_sensors_of_one_name_have_frames_of_their_own() -> None:
    eyes = "".join(SENSOR.format("camera", "0 0 0 0 0 0", "").replace('"base"', f'"{each}"') for each in ("base", "a"))
    links = f"{link('base')}{link('a')}{joint('j', 'a')}"
    urdf = twinform.loads(urdf_of(packaged(text=f'<robot name="r">{links}{eyes}</robot>'))).models[0]
    frames = FrameGraph(urdf)
    for each in ("base", "a"):
        assert frames.pose(f"{each}_eye_optical_frame", each).translation == pytest.approx((0, 0, 0))


def test_the_frame_that_a_sensor_names_stays_and_is_reported_where_the_sensor_is_elsewhere() -> None:
    named = "<gz_frame_id>base</gz_frame_id>"
    for pose, found in (("0 0 0 0 0 0", []), ("0 0 0 0 0 0.1", ["frame-elsewhere"])):
        built = packaged(text=f'<robot name="r">{link("base")}{SENSOR.format("imu", pose, named)}</robot>')
        assert [each for each in rules(built) if each.startswith("frame-")] == found
        assert named in urdf_of(built)


def test_a_sensor_on_a_joint_has_to_name_its_frame() -> None:
    joint = '<joint name="j" type="continuous"><parent link="base"/><child link="tip"/></joint>'
    sensor = '<gazebo reference="j"><sensor name="wrist" type="force_torque"><topic>f</topic></sensor></gazebo>'
    built = packaged(text=f'<robot name="r">{link("base")}{link("tip")}{joint}{sensor}</robot>')
    (report,) = [each for each in built.diagnostics if each.rule.name == "frame-not-in-tf"]
    assert report.message == "messages of sensor 'wrist' are in the frame 'r/j/wrist', which tf does not have"
    assert report.help == "write the link that it measures in into it: <gz_frame_id>LINK</gz_frame_id>"


def test_a_robot_that_does_not_move_needs_no_sliders() -> None:
    built = packaged(text=f'<robot name="r">{link("base")}</robot>')
    assert rules(built) == []
    for path in ("launch/display.launch.py", "package.xml"):
        content = built.package.files[path]
        assert isinstance(content, bytes)
        assert b"joint_state_publisher" not in content


@pytest.mark.parametrize(("base", "height"), [("base", b"0.2"), ("world", b"0")])
def test_a_robot_begins_on_the_ground_unless_the_world_holds_it(base: str, height: bytes) -> None:
    held = (
        f'<joint name="w" type="fixed"><parent link="world"/><child link="b"/></joint>{link("b")}<link name="world"/>'
    )
    built = packaged(text=f'<robot name="r">{held if base == "world" else link("base")}</robot>')
    content = built.package.files["launch/gazebo.launch.py"]
    assert isinstance(content, bytes)
    assert b"DeclareLaunchArgument('z', default_value='" + height + b"'" in content


def test_gazebo_starts_no_controllers_of_other_hardware() -> None:
    arm = system(interfaces("j", "position"))
    tool = system(
        interfaces("wrist", "", "force.x", tag="sensor", rest='<param name="frame_id">a</param>'),
        name="tool", kind="sensor", hardware="driver/Sensor",
    )  # fmt: skip
    files = packaged(text=ROBOT.replace("</robot>", f"{arm}{tool}</robot>")).package.files
    launch, controllers = (files[path] for path in ("launch/gazebo.launch.py", "config/controllers.yaml"))
    assert isinstance(launch, bytes)
    assert isinstance(controllers, bytes)
    assert b"wrist_broadcaster" in controllers
    assert b"joint_trajectory_controller" in launch
    assert b"wrist_broadcaster" not in launch


_DRIVE = "add-plugin{system=diff-drive left-joint=left_joint right-joint=right_joint}"


@pytest.mark.parametrize(("passes", "frame"), [(_DRIVE, b"*('-f', 'odom')"), ("", b"")])
def test_rviz_beside_gazebo_stands_where_the_drive_reports_odometry(passes: str, frame: bytes) -> None:
    wheels = (link("left"), link("right"))
    joints = (joint("left_joint", "left", "continuous", y=0.3), joint("right_joint", "right", "continuous", y=-0.3))
    files = packaged(text=f'<robot name="r">{"".join((link("base"), *wheels, *joints))}</robot>', passes=passes)
    launch = files.package.files["launch/gazebo.launch.py"]
    assert isinstance(launch, bytes)
    assert frame in launch
    assert (b"'-f'" in launch) == bool(frame)
    rviz = files.package.files["rviz/robot.rviz"]
    assert isinstance(rviz, bytes)
    assert b"Fixed Frame: base" in rviz
