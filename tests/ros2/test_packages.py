"""Each package is one to catkin, CMake, launch, yamllint, urdfdom, libsdformat and a shell."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from lxml import etree

from testbed.ros2.judges import manifest, yaml_problems
from testbed.ros2.launch_stubs import IncludeLaunchDescription, LaunchDescription, ParameterValue, described, texts
from testbed.ros2.packages import ROBOTS, ROOT, SAID, TUTORIAL, Made, install, make
from twinform.testing.oracles import libsdformat

_URI = re.compile(r"(?:package|model)://[^\s\"'<>]+")

VERSIONS = {"courier": "1.0.0", "crate": "1.0.0"}
"""Those that have one in a package.xml or model.config."""


@pytest.fixture(scope="module", params=ROBOTS)
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Made:
    return make(str(request.param), tmp_path_factory.mktemp("workspace"))


@pytest.fixture(scope="module")
def installed(made: Made) -> Made:
    if shutil.which("cmake") is None:
        pytest.skip("cmake is not installed")
    install(made)
    return made


def test_catkin_reads_the_manifest_without_a_warning(made: Made):
    found = manifest(made.folder)
    assert found.warnings == ()
    assert (found.name, found.version, found.build_type) == (made.name, VERSIONS.get(made.name, "0.1.0"), "ament_cmake")
    assert (found.description, found.maintainers, found.licenses) == (SAID[1], ((SAID[3], SAID[5]),), ("Apache-2.0",))


def test_what_launch_files_start_is_what_the_package_depends_on(installed: Made):
    depends = manifest(installed.folder).exec_depends
    for description in _launched(installed):
        assert {node.package for node in description.nodes} <= depends
    for each in _controllers(installed).values():
        assert each["type"].partition("/")[0] in depends


def test_every_folder_of_the_package_is_installed(installed: Made):
    written = {path.relative_to(installed.folder) for path in installed.folder.rglob("*") if path.is_file()}
    there = {path.relative_to(installed.share) for path in installed.share.rglob("*") if path.is_file()}
    build_time = {
        Path("CMakeLists.txt"),
        Path(".twinform-package"),
        *(each for each in written if each.parts[0] == "env-hooks"),
    }
    assert written - build_time <= there
    assert {each.parts[0] for each in there - written} == {"environment"}


def test_the_environment_leads_gazebo_to_every_file(installed: Made):
    hook = next(installed.share.glob("environment/*.sh"))
    variable = "IGN_GAZEBO_RESOURCE_PATH" if "fortress" in installed.name else "GZ_SIM_RESOURCE_PATH"
    script = f'ament_prepend_unique_value() {{ export "$1=$2"; }}; . "{hook}"; printf %s "${variable}"'
    done = subprocess.run(
        ["sh", "-euc", script],
        env={"AMENT_CURRENT_PREFIX": str(installed.prefix)},
        capture_output=True,
        text=True,
        check=True,
    )
    (operation, name, place) = hook.with_suffix(".dsv").read_text(encoding="utf-8").strip().split(";")
    assert (operation, name) == ("prepend-non-duplicate", variable)
    assert Path(done.stdout) == installed.prefix / place
    models = [*installed.share.glob("urdf/*"), *installed.share.glob("*.sdf")]
    uris = {uri for file in models for uri in _URI.findall(file.read_text(encoding="utf-8"))}
    if installed.name == "arm_description":
        assert {"package://arm_description/meshes/base.stl", "model://arm_description/meshes/base.stl"} <= uris
    for uri in uris:
        assert (Path(done.stdout) / uri.partition("://")[2]).is_file(), uri


def test_the_launch_files_name_files_that_are_there(installed: Made):
    for description in _launched(installed):
        paths = [text for text in texts(description) if text.startswith(str(installed.prefix)) and "\n" not in text]
        assert paths
        for path in paths:
            assert Path(path).is_file() or "ros_gz_sim" in path, path


def test_display_publishes_the_robot_and_its_joints(installed: Made):
    description = described(installed.share / "launch/display.launch.py", installed.prefix)
    urdf = installed.share / f"urdf/{installed.name}.urdf"
    published = description.node("robot_state_publisher").parameters[0]["robot_description"]
    assert published == ParameterValue(urdf.read_text(encoding="utf-8"), value_type=str)
    moves = [joint for joint in etree.parse(urdf).iter("joint") if joint.get("type") not in {None, "fixed", "floating"}]
    sliders = {node.package for node in description.nodes if node.package.startswith("joint_state_publisher")}
    assert sliders == ({"joint_state_publisher", "joint_state_publisher_gui"} if moves else set())


def test_gazebo_gets_the_world_the_robot_and_its_controllers(installed: Made):
    description = described(installed.share / "launch/gazebo.launch.py", installed.prefix)
    (gazebo,) = [each for each in description.initial_entities if isinstance(each, IncludeLaunchDescription)]
    arguments = {name: description.perform(text) for name, text in gazebo.launch_arguments}
    assert arguments == {"gz_args": f"-r '{installed.share}/worlds/{installed.name}.sdf'"}
    robot = description.node("robot_state_publisher").parameters[0]["robot_description"]
    assert isinstance(robot, ParameterValue)
    root = etree.fromstring(description.perform(robot.value).encode())
    spawn = [description.perform(text) for text in description.node("ros_gz_sim").arguments]
    assert spawn[:4] == ["-name", root.get("name"), "-topic", "robot_description"]
    controllers = list(_controllers(installed))
    if not controllers:
        assert not [node for node in description.nodes if node.package == "controller_manager"]
        return
    file = str(installed.share / "config/controllers.yaml")
    spawner = [description.perform(text) for text in description.node("controller_manager").arguments]
    assert spawner[: len(controllers) + 2] == [*controllers, "--param-file", file]
    assert [each.text for each in root.iterfind("gazebo/plugin/parameters")] == [file]


def test_rviz_shows_what_the_bridge_carries(installed: Made):
    shown = yaml.safe_load((installed.share / f"rviz/{installed.name}.rviz").read_text(encoding="utf-8"))
    manager = shown["Visualization Manager"]
    links = [link.get("name") for link in etree.parse(installed.share / f"urdf/{installed.name}.urdf").iter("link")]
    assert manager["Global Options"]["Fixed Frame"] in links
    bridge = yaml.safe_load((installed.share / "config/bridge.yaml").read_text(encoding="utf-8"))
    published = {f"/{each['ros_topic_name'].lstrip('/')}" for each in bridge if each["direction"] == "GZ_TO_ROS"}
    topics = {each["Topic"]["Value"] for each in manager["Displays"] if "Topic" in each}
    assert topics <= published
    if installed.name == "standard_robot":
        assert topics == {"/camera/image", "/scan", "/scan/points", "/odom"}


def test_the_controllers_are_those_of_the_tutorial(tmp_path: Path):
    shown = re.findall(r"^```yaml\n(.*?)^```$", TUTORIAL, re.MULTILINE | re.DOTALL)
    written = (make("courier", tmp_path).folder / "config/controllers.yaml").read_text(encoding="utf-8")
    assert [each in written for each in shown] == [True]


def test_yamllint_has_nothing_to_say(made: Made):
    files = [path for path in made.folder.rglob("*") if path.suffix in {".yaml", ".rviz"}]
    assert len(files) >= 2
    for path in files:
        assert yaml_problems(path.read_text(encoding="utf-8")) == [], path


def test_the_python_is_as_ros_formats_it(made: Made):
    ruff = shutil.which("ruff", path=str(ROOT / ".venv/bin")) or shutil.which("ruff")
    if ruff is None:
        pytest.skip("ruff is not installed")
    style = ["--isolated", "--line-length", "99", "--config"]
    folder = str(made.folder / "launch")
    for words in (
        ["format", "--check", *style, "format.quote-style='single'", folder],
        ["check", *style, "lint.flake8-quotes.inline-quotes='single'", "--select", "E,F,W,I,Q,UP,B,PTH,SIM", folder],
    ):
        done = subprocess.run([ruff, *words], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout


def test_urdfdom_reads_the_robot(made: Made):
    if shutil.which("check_urdf") is None:
        pytest.skip("check_urdf is not installed")
    urdf = made.folder / f"urdf/{made.name}.urdf"
    done = subprocess.run(["check_urdf", urdf], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_libsdformat_reads_the_robot_and_the_world(made: Made):
    files = [made.folder / f"urdf/{made.name}.urdf", made.folder / f"worlds/{made.name}.sdf"]
    assert [verdict.errors for verdict in libsdformat.judge(files).values()] == [(), ()]


def _controllers(made: Made) -> dict[str, dict[str, str]]:
    """The controllers by their names, as the manager is told of them."""
    file = made.folder / "config/controllers.yaml"
    if not file.exists():
        return {}
    read = yaml.safe_load(file.read_text(encoding="utf-8"))
    manager = read["controller_manager"]["ros__parameters"]
    return {name: each for name, each in manager.items() if isinstance(each, dict)}


def _launched(made: Made) -> Iterator[LaunchDescription]:
    for file in sorted(made.share.glob("launch/*.launch.py")):
        yield described(file, made.prefix)
