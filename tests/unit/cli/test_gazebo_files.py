from pathlib import Path

import pytest
from click.testing import CliRunner

import twinform
from twinform.cli import main
from twinform.passes.plugins.catalog import releases
from twinform.passes.plugins.sites import plugins_of

ROBOT = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>{}</robot>"""
IMU = '<gazebo reference="base"><sensor name="imu" type="imu"><topic>imu</topic></sensor></gazebo>'
WORLD = '<sdf version="1.11"><world name="w"><model name="m"><link name="l"/></model></world></sdf>'


def run(folder: Path, *words: str, robot: str = ROBOT.format(IMU), name: str = "r.urdf") -> tuple[int, str]:
    (folder / name).write_text(robot)
    done = CliRunner().invoke(main, ["convert", str(folder / name), *words], catch_exceptions=False)
    return done.exit_code, done.output


def test_files_are_written_beside_the_model(tmp_path: Path) -> None:
    bridge, world = tmp_path / "new/bridge.yaml", tmp_path / "world.sdf"
    code, _ = run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--bridge", str(bridge), "--world", str(world))
    assert code == 0
    assert '"/imu"' in bridge.read_text()
    made = twinform.load(world)
    assert [model.name for model in made.worlds[0].models] == ["ground_plane", "r"]
    names = [(plugin.name or "").rsplit("::", 1)[-1] for plugin, _ in plugins_of(made)]
    assert names == ["Physics", "UserCommands", "SceneBroadcaster", "Imu"]


def test_the_world_has_what_plugins_need(tmp_path: Path) -> None:
    boat = """<gazebo><plugin filename="gz-sim-hydrodynamics-system" name="gz::sim::systems::Hydrodynamics">
    <link_name>base</link_name></plugin><plugin filename="gz-sim-comms-endpoint-system"
    name="gz::sim::systems::CommsEndpoint"><address>a</address><topic>b</topic></plugin></gazebo>
    <gazebo reference="base"><sensor name="log" type="custom" gz:type="dvl"/></gazebo>"""
    world = tmp_path / "world.sdf"
    robot = ROBOT.format(boat).replace("<robot ", '<robot xmlns:gz="http://gazebosim.org/schema" ')
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--world", str(world), robot=robot)[0] == 0
    made = twinform.load(world).worlds[0]
    names = [(plugin.name or "").rsplit("::", 1)[-1] for plugin in made.plugins]
    assert names[3:] == ["DopplerVelocityLogSystem", "Buoyancy", "PerfectComms"]


def test_a_world_of_a_plain_robot_has_the_systems_of_every_world(tmp_path: Path) -> None:
    world = tmp_path / "world.sdf"
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--world", str(world), robot=ROBOT.format(""))[0] == 0
    assert len(plugins_of(twinform.load(world))) == 3


def test_the_world_is_of_the_version_that_was_asked_for(tmp_path: Path) -> None:
    world = tmp_path / "world.sdf"
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--sdf-version", "1.9", "--world", str(world))[0] == 0
    assert twinform.load(world).version == "1.9"


def test_the_release_decides_the_message_types_of_the_bridge(tmp_path: Path) -> None:
    bridge = tmp_path / "b.yaml"
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--bridge", str(bridge), "--gazebo", "fortress")[0] == 0
    assert "ignition.msgs.IMU" in bridge.read_text()


@pytest.mark.parametrize("release", releases())
def test_the_release_decides_the_version_of_sdf(tmp_path: Path, release: str) -> None:
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--gazebo", release)[0] == 0
    assert twinform.load(tmp_path / "r.sdf").version == releases()[release].sdf


def test_the_frame_of_a_sensor_arrives_in_the_release_that_reads_it(tmp_path: Path) -> None:
    framed = IMU.replace("<topic>", "<frame_id>base</frame_id><topic>")
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--gazebo", "jetty", robot=ROBOT.format(framed))[0] == 0
    assert "<frame_id>base</frame_id>" in (tmp_path / "r.sdf").read_text()


@pytest.mark.parametrize(("asked", "code"), [("1.8", 0), ("1.9", 0), ("1.10", 2)])
def test_a_version_that_the_release_does_not_read_is_refused(tmp_path: Path, asked: str, code: int) -> None:
    words = ("--gazebo", "fortress", "--sdf-version", asked)
    made, text = run(tmp_path, "-o", f"{tmp_path}/r.sdf", *words)
    assert made == code
    assert not code or "reads SDF up to 1.9" in text


@pytest.mark.parametrize("to", ["urdf", "sdf"])
def test_a_bridge_is_written_for_either_format(tmp_path: Path, to: str) -> None:
    bridge = tmp_path / "b.yaml"
    assert run(tmp_path, "-o", f"{tmp_path}/out.{to}", "--bridge", str(bridge))[0] == 0
    assert bridge.exists()


def test_a_file_with_a_world_is_not_put_into_another_one(tmp_path: Path) -> None:
    world = tmp_path / "other.sdf"
    words = ("--to", "sdf", "-o", f"{tmp_path}/out.sdf", "--world", str(world))
    code, text = run(tmp_path, *words, robot=WORLD, name="w.sdf")
    assert code == 1
    assert "[nothing-to-add-to]" in text
    assert not world.exists()


def test_nothing_is_written_for_a_model_with_an_error(tmp_path: Path) -> None:
    bridge = tmp_path / "b.yaml"
    robot = ROBOT.format('<joint name="j" type="fixed"><parent link="base"/><child link="nobody"/></joint>')
    assert run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--bridge", str(bridge), robot=robot)[0] == 1
    assert not bridge.exists()


def test_a_file_that_cannot_be_written_is_reported(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    code, text = run(tmp_path, "-o", f"{tmp_path}/r.sdf", "--bridge", f"{tmp_path}/taken/b.yaml")
    assert code == 2
    assert "cannot write" in text


def test_one_file_is_not_written_for_several_models(tmp_path: Path) -> None:
    (tmp_path / "other.urdf").write_text(ROBOT.format(IMU))
    bridge = tmp_path / "bridge.yaml"
    code, text = run(tmp_path, str(tmp_path / "other.urdf"), "-o", f"{tmp_path}/out/", "--bridge", str(bridge))
    assert (code, bridge.exists()) == (2, False)
    assert "--bridge and --world take one input" in text
