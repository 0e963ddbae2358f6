"""The standard robot: plain URDF to a robot that runs in Gazebo, by one pipeline, as the tutorial has it."""

import re
import shlex
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner
from lxml import etree

import twinform
from twinform.cli import main
from twinform.diagnostics import DiagnosticSink, Severity
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.passes.plugins.sites import plugins_of, sensors_of
from twinform.schemas import libxml2_errors
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import describe

_ROOT = Path(__file__).parents[1]
_TUTORIAL = (_ROOT / "docs/tutorial/standard-robot.md").read_text(encoding="utf-8")
_COMMAND = next(line[2:] for line in _TUTORIAL.splitlines() if line.startswith("$ ") and "--world" in line)
_BRIDGE = re.compile(r'ros_topic_name: "(.*)"\n  gz_topic_name: "(.*)"\n  ros_type_name: "(.*)"\n')


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("robot")
    return made(folder, _COMMAND)


def made(folder: Path, command: str) -> Path:
    shutil.copytree(_ROOT / "examples", folder / "examples")
    words = [word.replace("out/", f"{folder}/out/") for word in shlex.split(command)[1:]]
    words = [word.replace("examples/", f"{folder}/examples/") for word in words]
    done = CliRunner().invoke(main, words, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return folder / "out"


def test_the_robot_has_an_imu_a_camera_and_a_drive(out: Path) -> None:
    document = twinform.load(out / "standard_robot.sdf")
    assert document.version == "1.11"
    assert [(each.type, site.holder) for each, site in sensors_of(document)] == [
        ("imu", "base_link"),
        ("camera", "camera_mount"),
    ]
    drive = next(plugin for plugin, _ in plugins_of(document) if plugin.filename == "gz-sim-diff-drive-system")
    values = {each.name: each.text for each in drive.content}
    assert (values["wheel_separation"], values["wheel_radius"]) == ("0.38", "0.1")
    assert sum(each.name == "left_joint" for each in drive.content) == 2


def test_every_file_is_valid(out: Path) -> None:
    for file in ("standard_robot.sdf", "world.sdf"):
        found = twinform.check(out / file).diagnostics
        assert not [each for each in found if each.severity > Severity.INFO]
        xml = etree.parse(out / file).getroot()
        for element in [*xml.iter("gz_frame_id"), *xml.iter("{urn:twinform:1}*")]:
            above = element.getparent()
            assert above is not None
            above.remove(element)
        assert not libxml2_errors(xml, "sdf", (1, 11))


def test_the_world_has_all_that_the_robot_needs(out: Path) -> None:
    world, sink = twinform.load(out / "world.sdf"), DiagnosticSink()
    CheckPlugins().run(world, sink)
    assert not sink.diagnostics
    assert len(sensors_of(world)) == 2
    robot = world.worlds[0].models[-1]
    assert robot.pose
    assert robot.pose.xyz == (0, 0, 0.13)  # the axles are 0.03 m below the base, and the wheels have 0.1 m


def test_the_bridge_is_the_one_of_the_tutorial(out: Path) -> None:
    rows = _BRIDGE.findall((out / "bridge.yaml").read_text(encoding="utf-8"))
    shown = re.findall(r"^\| `(.+?)` \| `(.+?)` \| (\S+) \|", _TUTORIAL, re.MULTILINE)
    assert rows == shown


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_libsdformat_loads_the_robot_and_its_world(tmp_path: Path) -> None:
    older = made(tmp_path, f"{_COMMAND} --sdf-version 1.9")
    files = [older / "standard_robot.sdf", older / "world.sdf"]
    assert [verdict.errors for verdict in libsdformat.judge(files).values()] == [(), ()]
    masses = [link["mass"] for link in describe(files[0])["links"]]
    assert sum(masses) == pytest.approx(12 + 4 * 0.8 + 0.3)


def test_the_robot_comes_back_as_it_was(out: Path) -> None:
    back = twinform.convert(out / "standard_robot.sdf", to="urdf").document
    first = twinform.load(_ROOT / "examples/standard_robot.urdf")
    links = [link.name for link in back.models[0].links]
    assert links.pop(6) == "camera_optical_frame"  # which the pipeline adds for the camera
    assert links == [link.name for link in first.models[0].links]
    assert sorted((each.type, site.holder) for each, site in sensors_of(back)) == [
        ("camera", "camera_mount"),
        ("imu", "imu_link"),
    ]
