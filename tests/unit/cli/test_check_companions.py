"""Companion files of three robots: nothing is found in them, stale names are found where they stand, and names follow.

The robots are of our own, in the shape of public ones: an arm with MoveIt, a cart with Nav2, and one as of ROS 1.
"""

import json
import re
import shutil
from pathlib import Path

import pytest

import twinform

from .conftest import Run

pytest.importorskip("xacro")

_ROBOTS = Path(__file__).parents[2] / "cases/companions"
_SRDF = "lifter_moveit_config/config/lifter.srdf"
_MOVEIT = "lifter_moveit_config/config"
_CART = "cart_bringup/config"

PLANTED = [
    ("lifter", _SRDF, 'base_link="pedestal"', 'base_link="pedastal"', "stale-name"),
    ("lifter", _SRDF, 'tip_link="tool_plate"', 'tip_link="tool0"', "stale-name"),
    ("lifter", _SRDF, '<link name="left_jaw"/>', '<link name="left_finger"/>', "stale-name"),
    ("lifter", _SRDF, '<joint name="left_jaw_slide"/>', '<joint name="left_jaw_joint"/>', "stale-name"),
    (
        "lifter",
        _SRDF,
        '    <passive_joint name="right_jaw_slide"',
        '    <passive_joint name="right_slide"',
        "stale-name",
    ),
    ("lifter", _SRDF, '<group name="jaws"/>', '<group name="hand"/>', "stale-name"),
    ("lifter", _SRDF, 'name="parked" group="arm"', 'name="parked" group="lifter"', "stale-name"),
    ("lifter", _SRDF, '<joint name="raise" value', '<joint name="lift" value', "stale-name"),
    ("lifter", _SRDF, 'parent_link="tool_plate"', 'parent_link="plate"', "stale-name"),
    ("lifter", _SRDF, 'parent_group="arm"', 'parent_group="arms"', "stale-name"),
    ("lifter", _SRDF, 'group="jaws"/>\n  <pass', 'group="jaw"/>\n  <pass', "stale-name"),
    ("lifter", _SRDF, 'child_link="pedestal"', 'child_link="base_link"', "stale-name"),
    ("lifter", _SRDF, '"turret" link2="boom"', '"turret" link2="beam"', "stale-name"),
    ("lifter", _SRDF, 'link1="left_jaw"', 'link1="left_claw"', "stale-name"),
    ("lifter", f"{_MOVEIT}/joint_limits.yaml", "  raise:", "  lift:", "stale-name"),
    ("lifter", f"{_MOVEIT}/kinematics.yaml", "arm:", "manipulator:", "stale-name"),
    ("lifter", f"{_MOVEIT}/ompl_planning.yaml", "jaws:", "gripper:", "stale-name"),
    ("lifter", f"{_MOVEIT}/moveit_controllers.yaml", "[turn, raise]", "[turn, rise]", "stale-name"),
    ("lifter", f"{_MOVEIT}/moveit_controllers.yaml", "- jaw_controller", "- gripper_controller", "stale-name"),
    ("lifter", f"{_MOVEIT}/moveit_controllers.yaml", "'left_jaw_slide'", "'left_jaw'", "stale-name"),
    ("lifter", f"{_MOVEIT}/ros2_controllers.yaml", "- turn", "- pan", "stale-name"),
    ("lifter", f"{_MOVEIT}/ros2_controllers.yaml", "turn: {", "pan: {", "stale-name"),
    ("lifter", f"{_MOVEIT}/ros2_controllers.yaml", "gains.raise.p", "gains.rise.p", "stale-name"),
    ("lifter", f"{_MOVEIT}/ros2_controllers.yaml", "joint: left_jaw_slide", "joint: jaw", "stale-name"),
    ("cart", f"{_CART}/controllers.yaml", "'left_wheel_axle'", "'left_wheel_joint'", "stale-name"),
    ("cart", f"{_CART}/controllers.yaml", '"right_wheel_axle"', '"right_wheel"', "stale-name"),
    ("cart", f"{_CART}/controllers.yaml", "sensor_name: tilt", "sensor_name: imu", "stale-name"),
    ("cart", f"{_CART}/controllers.yaml", "base_frame_id: ground_center", "base_frame_id: base", "stale-frame"),
    ("cart", f"{_CART}/controllers.yaml", "frame_id: chassis", "frame_id: chasis", "stale-frame"),
    ("cart", f"{_CART}/nav2.yaml", '"ground_center"', '"base_footprint"', "stale-frame"),
    ("cart", f"{_CART}/nav2.yaml", "sensor_frame: scanner", "sensor_frame: laser", "stale-frame"),
    (
        "cart",
        f"{_CART}/nav2.yaml",
        "base_frame: chassis\n      foot",
        "base_frame: base_link\n      foot",
        "stale-frame",
    ),
    ("cart", f"{_CART}/ekf.yaml", "ground_center", "base_link", "stale-frame"),
    ("probe", "config/probe.srdf.xacro", '<joint name="neck"/>', '<joint name="nck"/>', "stale-name"),
    ("probe", "config/probe.srdf.xacro", 'link2="head"', 'link2="skull"', "stale-name"),
    ("probe", "config/controllers.yaml", "joints: [neck]", "joints: [throat]", "stale-name"),
    ("probe", "config/controllers.yaml", "joint: neck", "joint: throat", "stale-name"),
]
"""A robot, a file of it, a piece of that, what it becomes, and the rule that finds it."""

MISTAKES = [
    (_SRDF, '"floor" value="0 0 0"', '"floor" value="0"', "impossible-state"),
    (_SRDF, 'name="turn" value="-1.2"', 'name="turn" value="3.1"', "impossible-state"),
    (_SRDF, 'name="turn" value="-1.2"', 'name="turn" value="left"', "impossible-state"),
    (_SRDF, '<joint name="turn" value', '<joint name="left_jaw_slide" value', "impossible-state"),
    (_SRDF, '<group_state name="parked" group="arm">', '<group_state name="p" group="all">', "impossible-state"),
    (_SRDF, 'child_link="pedestal"', 'child_link="turret"', "broken-semantics"),
    (_SRDF, 'type="planar"', 'type="flat"', "broken-semantics"),
    (_SRDF, '<group name="all">\n', '<group name="all">\n<group name="all"/>\n', "broken-semantics"),
    (_SRDF, 'parent_link="tool_plate"', 'parent_link="left_jaw"', "broken-semantics"),
    (_SRDF, 'group_state name="open" group="jaws"', 'group_state name="parked" group="arm"', "repeated-semantics"),
    (_SRDF, '"left_jaw" link2="right_jaw"', '"boom" link2="turret"', "repeated-semantics"),
    (_SRDF, '"left_jaw" link2="right_jaw"', '"boom" link2="boom"', "repeated-semantics"),
    (f"{_MOVEIT}/joint_limits.yaml", "max_velocity: 1.0", "max_velocity: 15", "loosened-limit"),
    (f"{_MOVEIT}/joint_limits.yaml", "min_position: 0.05", "min_position: -0.5", "loosened-limit"),
    (f"{_MOVEIT}/joint_limits.yaml", "max_position: 0.55", "max_velocity: 0.1", "repeated-key"),
    (f"{_MOVEIT}/ros2_controllers.yaml", "[position, velocity]", "[position, effort]", "missing-interface"),
    (f"{_MOVEIT}/ros2_controllers.yaml", "joint: left_jaw_slide", "joint: right_jaw_slide", "missing-interface"),
    (f"{_MOVEIT}/ros2_controllers.yaml", "[position, velocity]", "[position, velocity", "broken-parameters"),
    (f"{_CART}/nav2.yaml", '"[[0.25, 0.2], [0.25, -0.2], [-0.25, -0.2], ', '"[[0.25, 0.2], ', "broken-footprint"),
    (f"{_MOVEIT}/ros2_controllers.yaml", "/JointTrajectoryC", "/JointTrajectryC", "misspelled-interface"),
    (f"{_MOVEIT}/ros2_controllers.yaml", "lift_controller:\n  ros", "lift_controler:\n  ros", "stale-name"),
    (f"{_CART}/nav2.yaml", '"[[0.25, 0.2], ', '"[[0.25 0.2], ', "broken-footprint"),
    (
        f"{_CART}/nav2.yaml",
        '"[[0.25, 0.2], [0.25, -0.2], [-0.25, -0',
        '"[[1, 1], [2, 2], [3, 3], [0',
        "broken-footprint",
    ),
]


@pytest.fixture
def robots(tmp_path: Path) -> Path:
    shutil.copytree(_ROBOTS, tmp_path, dirs_exist_ok=True)
    return tmp_path


def _findings(run: Run, folder: Path, *options: str) -> list[tuple[str, str, int, str]]:
    """The file, rule, line and severity of each finding."""
    done = run("check", folder, *options, "--format", "json", "--no-cache", "--no-config")
    return [
        (Path(row.get("file") or file["path"]).name, row["rule"], row["line"], row["severity"])
        for file in json.loads(done.stdout)["files"]
        for row in file["diagnostics"]
        if row["severity"] != "info"
    ]


def _replace(path: Path, old: str, new: str) -> int:
    """Replace a piece of a file that is there once or first; the line of what it becomes."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return text[: text.index(old)].count("\n") + 1


@pytest.mark.parametrize("robot", ["lifter", "cart", "probe"])
def test_nothing_is_found_in_what_fits(run: Run, robots: Path, robot: str) -> None:
    assert _findings(run, robots / robot) == []
    assert "0 notes" in run("check", robots / robot, "--notes", "--no-config").stderr


@pytest.mark.parametrize(("robot", "file", "old", "new", "rule"), PLANTED, ids=lambda value: value.strip()[:24])
def test_a_stale_name_is_found_where_it_stands(
    run: Run, robots: Path, robot: str, file: str, old: str, new: str, rule: str
) -> None:
    path = robots / robot / file
    line = _replace(path, old, new)
    found = _findings(run, path)
    assert {(path.name, rule, line)} == {each[:3] for each in found if each[1] in {"stale-name", "stale-frame"}}


@pytest.mark.parametrize(("file", "old", "new", "rule"), MISTAKES, ids=lambda value: value.strip()[:24])
def test_what_moveit_nav2_and_controllers_refuse_is_found(
    run: Run, robots: Path, file: str, old: str, new: str, rule: str
) -> None:
    path = next(robots.glob(f"*/{file}"))
    line = _replace(path, old, new)
    lines = [each[2] for each in _findings(run, path) if each[:2] == (path.name, rule)]
    assert lines
    assert line in lines or rule == "broken-parameters"


def test_a_comment_allows_a_finding_and_a_baseline_knows_it(run: Run, robots: Path) -> None:
    path = robots / "cart" / _CART / "ekf.yaml"
    line = _replace(
        path, "base_link_frame: ground_center", "base_link_frame: base  # twinform: allow stale-frame - mine"
    )
    assert _findings(run, path) == []
    _replace(path, "  # twinform: allow stale-frame - mine", "")
    assert _findings(run, path) == [("ekf.yaml", "stale-frame", line, "warning")]
    known = robots / "known.json"
    assert run("check", path, "--baseline", known, "--update-baseline").exit_code == 0
    _replace(path, "ekf_filter_node:", "# moved down\nekf_filter_node:")
    assert run("check", path, "--baseline", known).stdout == ""
    _replace(path, "ekf_filter_node:", "# twinform: allow stale-frame\nekf_filter_node:")
    assert _findings(run, path) == []


def test_findings_have_the_columns_of_their_names(run: Run, robots: Path) -> None:
    path = robots / "lifter" / _MOVEIT / "moveit_controllers.yaml"
    _replace(path, "[turn, raise]", "[turn, rais]")
    shown = run("check", path, "--no-config").stdout
    assert "moveit_controllers.yaml:9:20: warning: there is no joint 'rais'" in shown
    assert "did you mean 'raise'?" in shown
    result = json.loads(run("check", path, "--format", "sarif", "--no-config").stdout)["runs"][0]["results"][0]
    region = result["locations"][0]["physicalLocation"]["region"]
    assert (region["startLine"], region["startColumn"], region["endColumn"]) == (9, 20, 24)


def test_without_a_robot_or_with_many_nothing_is_guessed(run: Run, robots: Path) -> None:
    path = robots / "lone.yaml"
    path.write_text("left_wheel_names: [l]\nright_wheel_names: [r]\n", encoding="utf-8")
    shutil.rmtree(robots / "probe")
    for name in ("lifter", "cart"):
        shutil.rmtree(robots / name)
    done = run("check", path, "--notes", "--no-config")
    assert "robot-not-found" in done.stdout
    robot = '<robot name="{0}"><link name="a"/><link name="b"/><joint name="{0}" type="fixed"><parent link="a"/>'
    for name in ("l", "r"):
        (robots / f"{name}.urdf").write_text(f'{robot.format(name)}<child link="b"/></joint></robot>')
    assert _findings(run, path) == []  # each is of one of them
    found = _findings(run, path, "--robot", str(robots / "l.urdf"))
    assert found == [("lone.yaml", "stale-name", 2, "error")]
    (robots / "twinform.toml").write_text('[[files]]\nmatch = ["lone.yaml"]\nrobot = "r.urdf"\n')
    done = run("check", path, "--config", robots / "twinform.toml")
    assert "lone.yaml:1:20: error: there is no joint 'l', which the robot 'r' does not have" in done.stdout
    (robots / "twinform.toml").write_text('[[files]]\nmatch = ["lone.yaml"]\nrobot = "../r.urdf"\n')
    assert "leads out of the folder" in run("check", path, "--config", robots / "twinform.toml").stderr


def test_other_yaml_is_left_alone(run: Run, robots: Path) -> None:
    others = {
        "units.yaml": "joint_limits:\n  turn: {max_velocity: !degrees 90, has_velocity_limits: true}\n",
        "template.yaml": "joint_limits:\n  {{ joint }}:\n    max_velocity: 1\n",
        "workflow.yml": "jobs:\n  test: {steps: [a, b]}\n",
        "broken.yml": "a: [b\n",
        "schema.yaml": "jaw:\n  joints: {type: string_array, default_value: []}\n",
    }
    for name, text in others.items():
        (robots / "lifter" / _MOVEIT / name).write_text(text, encoding="utf-8")
    assert _findings(run, robots / "lifter") == []
    assert "7 files" in run("check", robots / "lifter", "--no-config").stderr


def test_controllers_that_are_described_elsewhere_are_not_stale(run: Run, robots: Path) -> None:
    others = {
        "poses.yaml": "walk_pose:\n  controller_names:\n    - arm_controller\n    - head_controller\n",
    }
    for name, text in others.items():
        (robots / "lifter" / _MOVEIT / name).write_text(text, encoding="utf-8")
    assert _findings(run, robots / "lifter") == []


def test_the_footprint_of_what_walks_is_no_link(run: Run, tmp_path: Path) -> None:
    limit = '<limit upper="1" effort="1" velocity="1"/>'
    joint = f'<joint name="j" type="{{}}"><parent link="base"/><child link="leg"/>{limit}</joint>'
    mass = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    robot = f'<robot name="r"><link name="base"/><link name="leg">{mass}</link>{joint}</robot>'
    file, options = tmp_path / "r.urdf", ("--robot", str(tmp_path / "r.urdf"))
    (tmp_path / "costmap.yaml").write_text("local_costmap:\n  robot_base_frame: base_footprint\n", encoding="utf-8")
    file.write_text(robot.format("revolute"))
    assert _findings(run, tmp_path, *options) == []
    file.write_text(robot.format("continuous"))
    assert _findings(run, tmp_path, *options) == [("costmap.yaml", "stale-frame", 2, "warning")]


_RENAME = "rename{names=[turn:pan,pedestal:base,tool_plate:wrist]}"
_FOLLOWING = {
    _SRDF: 6,
    f"{_MOVEIT}/joint_limits.yaml": 1,
    f"{_MOVEIT}/moveit_controllers.yaml": 1,
    f"{_MOVEIT}/ros2_controllers.yaml": 2,
}


@pytest.mark.parametrize("command", ["fix", "convert"])
def test_a_rename_follows_everywhere_and_changes_no_other_byte(run: Run, robots: Path, command: str) -> None:
    lifter = robots / "lifter"
    before = {path: path.read_bytes() for path in lifter.rglob("*") if path.is_file()}
    urdf = lifter / "lifter_description/urdf/lifter.urdf"
    options = ("--in-place", "--to", "urdf") if command == "convert" else ()
    done = run(command, urdf, *options, "--passes", _RENAME, "--no-config")
    assert done.exit_code == 0, done.stderr
    changed = {path for path, data in before.items() if path.read_bytes() != data}
    assert changed == {urdf, *(lifter / name for name in _FOLLOWING)}
    for name, count in _FOLLOWING.items():
        path = lifter / name
        old = before[path].decode()
        assert path.read_text(encoding="utf-8") == re.sub(
            r"\b(turn|pedestal|tool_plate)\b",
            lambda found: {"turn": "pan", "pedestal": "base", "tool_plate": "wrist"}[found[0]],
            old,
        )
        assert f"{path}: {count} name{'s' if count > 1 else ''} followed" in done.stderr
    assert _findings(run, lifter) == []


def test_a_prefix_follows_and_what_another_robot_has_stays(run: Run, robots: Path) -> None:
    lifter = robots / "lifter"
    urdf = lifter / "lifter_description/urdf/lifter.urdf"
    done = run("fix", urdf, "--passes", "prefix-names{prefix=l_}", "--diff", "--no-config")
    assert "+    joints: [l_turn, l_raise]" in done.stdout
    assert urdf.read_text(encoding="utf-8").count("l_turn") == 0
    shutil.rmtree(lifter / "lifter_moveit_config")
    limits = lifter / "limits.yaml"
    limits.write_text("joint_limits:\n  turn: {max_velocity: 1}\n", encoding="utf-8")
    shutil.copy(urdf, lifter / "lifter_description/urdf/other.urdf")
    assert run("fix", urdf, "--passes", "rename{names=[turn:pan]}", "--no-config").exit_code == 0
    assert "turn" in limits.read_text(encoding="utf-8")


def test_python_checks_companion_files_as_well(robots: Path) -> None:
    limits = robots / "lifter" / _MOVEIT / "joint_limits.yaml"
    assert twinform.check(limits).diagnostics == ()
    other = robots / "probe/urdf/probe.urdf"
    found = twinform.check(limits, robot=other, allow=["loosened-limit"]).diagnostics
    assert [(each.rule.name, each.location.line) for each in found] == [("stale-name", 4), ("stale-name", 8)]


def test_parts_that_a_robot_has_with_other_arguments_are_not_stale(run: Run, here_with_choice: Path) -> None:
    assert _findings(run, here_with_choice) == []
    path = here_with_choice / "arm.srdf"
    line = _replace(path, "left_claw", "left_clow")
    assert [each for each in _findings(run, here_with_choice) if each[1] == "stale-name"] == [
        ("arm.srdf", "stale-name", line, "warning")
    ]


@pytest.fixture
def here_with_choice(tmp_path: Path) -> Path:
    (tmp_path / "arm.urdf.xacro").write_text(
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n<xacro:arg name="claw" default="false"/>\n'
        '<xacro:macro name="claw" params="side"><link name="${side}_claw"/><joint name="${side}_hold" type="fixed">'
        '<parent link="base"/><child link="${side}_claw"/></joint></xacro:macro>\n<link name="base"/>\n'
        '<xacro:if value="$(arg claw)"><xacro:claw side="left"/></xacro:if>\n</robot>'
    )
    (tmp_path / "arm.srdf").write_text(
        '<robot name="arm">\n<group name="all">\n<chain base_link="base" tip_link="left_claw"/></group>\n'
        '<group_state name="s" group="all"><joint name="left_hold" value="0"/></group_state>\n</robot>'
    )
    return tmp_path
