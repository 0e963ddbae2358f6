"""Robots in Gazebo's own physics: what is converted loads, stands and drives as its source does."""

from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from lxml import etree

import twinform
from testbed.engines import gazebo
from testbed.engines.gazebo.comparison import differences
from testbed.engines.gazebo.differing import Tolerances, short
from testbed.engines.gazebo.joints import chains
from testbed.engines.gazebo.reading import console
from tests.snippets import INERTIAL
from twinform.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
SDF_VERSION = "1.9"
"""The newest that libsdformat 12 reads."""
FORMS = ("urdf", "sdf", "urdf from sdf")
RATE, TORQUE, SECONDS = 4.0, 0.3, 2.0
WHEELED = {"rover": (0.09, 0.0), "four_wheels": (0.1, -0.15), "standard_robot": (0.1, -0.13)}
"""The radius of the wheels in m, and the height of the floor that they touch in the frame of the model."""

pytestmark = pytest.mark.skipif(not gazebo.available(), reason=gazebo.MISSING)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("gazebo")


def _form(name: str, form: str, folder: Path) -> Path:
    """An example as it is, as SDF, or as the URDF that becomes of that SDF."""
    source = EXAMPLES / f"{name}.urdf"
    if form == "urdf":
        return source
    sdf = folder / f"{name}.sdf"
    sdf.write_text(twinform.convert(source, to="sdf", sdf_version=SDF_VERSION).text, encoding="utf-8")
    if form == "sdf":
        return sdf
    urdf = folder / f"{name}.urdf"
    urdf.write_text(twinform.convert(sdf, to="urdf").text, encoding="utf-8")
    return urdf


@cache
def _wheels(name: str) -> tuple[str, ...]:
    joints = twinform.load(EXAMPLES / f"{name}.urdf").models[0].joints
    return tuple(joint.name for joint in joints if "wheel" in joint.name)


def _run(path: Path, settings: gazebo.Settings) -> gazebo.Simulation:
    return gazebo.simulate([path], settings=settings)[path.resolve()].required()


def _way(simulation: gazebo.Simulation) -> float:
    """How far the first link of the robot went along x, in m."""
    first = next(link.name for link in simulation.links if not link.name.startswith("ground"))
    start, *_, end = (moment.links[first].pose for moment in simulation.moments)
    assert abs(end[1]) < 0.01
    assert abs(end[2] - start[2]) < 0.01
    return end[0] - start[0]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", WHEELED)
def test_a_robot_drives_as_far_as_its_wheels_turn(name: str, form: str, folder: Path) -> None:
    radius, floor = WHEELED[name]
    steps, speeds = int(SECONDS * 1000), dict.fromkeys(_wheels(name), RATE)
    done = _run(_form(name, form, folder), gazebo.Settings(steps=steps, ground=floor, velocities=speeds))
    assert _way(done) == pytest.approx(RATE * radius * SECONDS, rel=0.02)
    assert not done.console.errors


@pytest.mark.parametrize("form", FORMS)
def test_torque_on_the_wheels_accelerates_the_robot(form: str, folder: Path) -> None:
    name = "standard_robot"  # its wheels turn without damping and friction
    radius, floor = WHEELED[name]
    steps, torques = int(SECONDS * 1000), dict.fromkeys(_wheels(name), TORQUE)
    done = _run(_form(name, form, folder), gazebo.Settings(steps=steps, ground=floor, forces=torques))
    mass = sum(link.mass or 0.0 for link in done.links if not link.name.startswith("ground"))
    # the axle is z of a wheel
    spun = sum(link.moments[2] / radius**2 for link in done.links if "wheel" in link.name)
    acceleration = len(torques) * TORQUE / radius / (mass + spun)
    assert _way(done) == pytest.approx(acceleration * SECONDS**2 / 2, rel=0.02)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["rover", "four_wheels"])
def test_torque_drives_a_robot_with_friction_as_its_source(name: str, form: str, folder: Path) -> None:
    settings = gazebo.Settings(
        steps=int(SECONDS * 1000), ground=WHEELED[name][1], forces=dict.fromkeys(_wheels(name), TORQUE)
    )
    expected = _way(_run(_form(name, "urdf", folder), settings))
    assert expected > 0.5
    assert _way(_run(_form(name, form, folder), settings)) == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("form", FORMS)
def test_an_arm_turns_its_joints_as_fast_as_they_are_commanded(form: str, folder: Path) -> None:
    path = _form("arm", form, folder)
    turning = [
        joint
        for joint in _run(path, gazebo.Settings()).joints
        if joint.inside and joint.kind == "revolute" and joint.inside.upper[0] > 0.2
    ]
    assert len(turning) >= 3
    speeds = {short(joint.name): 0.2 for joint in turning}
    done = _run(path, gazebo.Settings(steps=500, velocities=speeds))
    turned = [done.moments[-1].positions[joint.name][0] for joint in turning]
    assert turned == pytest.approx([0.1] * len(turning), rel=0.02)


@pytest.mark.parametrize("name", ["arm", "four_wheels", "gripper", "rover", "sensor_base", "standard_robot"])
def test_an_example_is_the_same_robot(name: str, folder: Path) -> None:
    settings = gazebo.Settings(steps=200, start=0.5)
    reference = _run(EXAMPLES / f"{name}.urdf", settings)
    for form in FORMS[1:]:
        result = _run(_form(name, form, folder), settings)
        # a link without mass is a warning of DART, not an error
        found = [each for each in differences(reference, result, Tolerances()) if each.what != "new warning line"]
        assert not found, (form, [str(each) for each in found])


def _convert(*words: str) -> None:
    done = CliRunner().invoke(main, ["convert", *words], catch_exceptions=False)
    assert done.exit_code == 0, done.output


def _stands(simulation: gazebo.Simulation, names: set[str]) -> None:
    """Every model is there, and nothing fell through the floor or flew off."""
    assert names <= {link.name.partition("::")[0] for link in simulation.links}
    assert not simulation.console.errors
    last = simulation.moments[-1].links
    assert all(abs(state.pose[i]) < 20 for state in last.values() for i in range(3))
    assert all(state.pose[2] > -0.05 for name, state in last.items() if not name.startswith("ground"))


def test_a_world_that_is_made_beside_a_robot_runs(folder: Path) -> None:
    model, world = folder / "made.sdf", folder / "made_world.sdf"
    source = str(EXAMPLES / "standard_robot.urdf")
    _convert(source, "--to", "sdf", "--sdf-version", SDF_VERSION, "-o", str(model), "--world", str(world))
    done = _run(world, gazebo.Settings(steps=1000, velocities=dict.fromkeys(_wheels("standard_robot"), RATE)))
    _stands(done, {"ground_plane", "standard_robot"})
    assert _way(done) == pytest.approx(RATE * 0.1, rel=0.05)


def test_a_world_that_is_split_runs(folder: Path) -> None:
    parts = folder / "split"
    _convert(str(EXAMPLES / "warehouse.sdf"), "--to", "urdf", "--split", "-o", str(parts))
    settings = gazebo.Settings(steps=500, folders=(parts, EXAMPLES))
    done = gazebo.simulate([parts / "warehouse.sdf"], settings=settings)[parts / "warehouse.sdf"].required()
    assert {"shelf", "lift_cart", "crate_1"} <= {link.name.partition("::")[0] for link in done.links}


def _drop_includes_of_fuel(path: Path) -> None:
    """Leave out what has to be downloaded: the sun and the ground plane."""
    tree = etree.parse(path)
    for include in tree.findall(".//include"):
        above = include.getparent()
        assert above is not None
        if include.findtext("uri", "").startswith("https://fuel."):
            above.remove(include)
    tree.write(path)


@pytest.mark.parametrize("name", ["classic_yard.sdf", "classic_rover.urdf"])
def test_what_is_migrated_from_gazebo_classic_runs(name: str, folder: Path) -> None:
    model, world = folder / f"{name}.gz.sdf", folder / f"{name}.world.sdf"
    options = ["--to", "sdf", "--sdf-version", SDF_VERSION, "--passes", "migrate-gazebo-classic", "-o", str(model)]
    _convert(str(EXAMPLES / name), *options, *(["--world", str(world)] if name.endswith(".urdf") else []))
    path = world if name.endswith(".urdf") else model
    _drop_includes_of_fuel(path)
    done = _run(path, gazebo.Settings(steps=500))
    assert done.links
    assert not done.console.errors


LINK = f'<link name="{{}}">{INERTIAL}</link>'
FREEDOMS = {"revolute": 1, "continuous": 1, "prismatic": 1, "fixed": 0}


@pytest.mark.parametrize("kind", FREEDOMS)
def test_a_joint_has_its_degrees_of_freedom(kind: str, folder: Path) -> None:
    joint = (
        f'<joint name="j" type="{kind}"><parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'
        '<axis xyz="0.6 0 0.8"/><limit lower="-1" upper="2" effort="5" velocity="7"/></joint>'
    )
    path = folder / f"{kind}.sdf"
    text = f'<robot name="r">{LINK.format("a")}{LINK.format("b")}{joint}</robot>'
    path.write_text(twinform.convert(text.encode(), to="sdf", sdf_version=SDF_VERSION).text, encoding="utf-8")
    for engine in (gazebo.PhysicsEngine.DART, gazebo.PhysicsEngine.BULLET):
        done = gazebo.simulate([path], engine, gazebo.Settings(steps=10))[path.resolve()].required()
        if engine is gazebo.PhysicsEngine.BULLET and kind == "prismatic":
            assert "not supported" in " ".join(done.console.errors)
            continue
        assert [joint.freedom for joint in done.joints] == [FREEDOMS[kind]]
        assert not done.console.errors


CHAINED = """<sdf version="1.9"><model name="m">
<link name="a">{0}</link><link name="b"><pose>1 0 0 0.1 0.2 0.3</pose>{0}</link>
<link name="c"><pose>2 0.3 0 0 0 0</pose>{0}</link>
<joint name="w" type="fixed"><parent>world</parent><child>a</child></joint>
<joint name="j" type="{1}"><parent>a</parent><child>b</child>{2}</joint>
<joint name="k" type="revolute"><parent>b</parent><child>c</child><axis><xyz>0 0.6 0.8</xyz></axis></joint>
</model></sdf>"""
SDF_BODY = """<inertial><pose>0 0 0 0.3 0.2 0.1</pose><mass>1</mass>
<inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia></inertial>"""
CHAINS = {  # with what differs in DART for a known cause
    "universal": ("<axis><xyz>0 1 0</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>", set[str]()),
    "revolute2": ("<axis><xyz>0 1 0</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>", {"degrees of freedom", "motion"}),
    "ball": ("", {"motion"}),
    "screw": ("<axis><xyz>0 0 1</xyz></axis><thread_pitch>10</thread_pitch>", {"degrees of freedom", "motion"}),
}


@pytest.mark.parametrize("kind", CHAINS)
def test_a_chain_of_urdf_is_the_joint_that_it_stands_for(kind: str, folder: Path) -> None:
    inside, known = CHAINS[kind]
    sdf, urdf = folder / f"{kind}_chain.sdf", folder / f"{kind}_chain.urdf"
    sdf.write_text(CHAINED.format(SDF_BODY, kind, inside), encoding="utf-8")
    urdf.write_text(twinform.convert(sdf, to="urdf").text, encoding="utf-8")
    settings = gazebo.Settings(steps=200, start=0.5)
    reference, result = (_run(path, settings) for path in (sdf, urdf))
    assert {"j", "k"} <= {short(joint.name) for joint in result.joints if joint.freedom}
    assert chains(reference, result).keys() == {"j"}
    found = list(differences(reference, result, Tolerances(moved=1e-3 if kind == "ball" else 1e-5), frames=False))
    assert {each.what for each in found} <= known, list(map(str, found))


def test_an_inertia_is_turned_once(folder: Path) -> None:
    path = folder / "turned.sdf"
    body = SDF_BODY.replace("0.3 0.2 0.1", "0 0 1.5707963267948966")
    path.write_text(f'<sdf version="1.9"><model name="m"><link name="a">{body}</link></model></sdf>', encoding="utf-8")
    (link,) = _run(path, gazebo.Settings()).links
    assert link.moments == pytest.approx((0.2, 0.1, 0.25, 0, 0, 0), abs=1e-12)


def test_a_crash_and_a_refusal_are_results(folder: Path) -> None:
    crash, wrong = folder / "crash.sdf", folder / "wrong.sdf"
    nothing = "<inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia></inertial>"
    crash.write_text(
        f'<sdf version="1.9"><model name="m"><link name="a"/><link name="b">{nothing}</link>'
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child>'
        "<axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"
    )
    wrong.write_text('<sdf version="1.9"><model name="m"/></sdf>')
    found = gazebo.simulate([crash, wrong], settings=gazebo.Settings(steps=10))
    assert found[crash.resolve()].outcome is gazebo.Outcome.CRASHED
    assert found[crash.resolve()].stage == "step 1"
    assert "assertion" in " ".join(found[crash.resolve()].console.errors)
    assert found[wrong.resolve()].outcome is gazebo.Outcome.REFUSED
    assert found[wrong.resolve()].errors


def test_lines_of_the_console_are_sorted_by_how_grave_they_are() -> None:
    text = "\x1b[1;31m[Err] [A.cc:1] \x1b[0mbad\n\x1b[1;33mWarning [B.cpp:2]\x1b[0m odd\n[Msg] fine\n"
    text += "run: ./dart/Joint.hpp:17: void f() [with T = X]: Assertion `!isNan(a)' failed.\n"
    found = console(text)
    assert found.errors == ("bad", "assertion !isNan(a) of Joint.hpp failed")
    assert (found.warnings, found.other) == (("odd",), ("fine",))
