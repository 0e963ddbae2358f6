"""Physics engines say whether two files are the same robot, and by how much they differ."""

import os
import signal
from itertools import product
from pathlib import Path

import pytest

import twinform
from tests.profile import DEEP
from twinform.testing import oracles
from twinform.testing.oracles.isolated import ChildDiedError, call

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[3] / "examples"
BOTH = ("drake", "libsdformat")
"""Those that read SDF too."""
ROBOT = """<robot name="pendulum">
  <link name="base">
    <inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="arm"/>
    <origin xyz="0 0.1 1" rpy="0.1 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="3" velocity="4"/><dynamics damping="0.1" friction="0.2"/>
  </joint>
  <link name="arm">
    <inertial>
      <origin xyz="0 0 -0.4" rpy="0 0.2 0"/>
      <mass value="1"/><inertia ixx="0.03" ixy="0" ixz="0.001" iyy="0.03" iyz="0" izz="0.02"/>
    </inertial>
    <visual><geometry><mesh filename="package://nowhere/arm.stl"/></geometry></visual>
  </link>
  <joint name="grip" type="fixed">
    <parent link="arm"/><child link="hand"/><origin xyz="0 0 -1"/>
  </joint>
  <link name="hand">
    <inertial><mass value="0.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>
</robot>
"""
SDF = """<sdf version="1.9"><model name="slider">
  <pose>1 2 3 0 0 0.4</pose>
  <frame name="tilted" attached_to="base"><pose>0 0.1 1 0.3 0 0</pose></frame>
  <link name="base"><inertial><mass>2</mass></inertial></link>
  <joint name="slide" type="prismatic">
    <pose relative_to="tilted">0 0 0.2 0 0 0</pose><parent>base</parent><child>sledge</child>
    <axis>
      <xyz expressed_in="__model__">0 1 0</xyz>
      <limit><lower>-1</lower><upper>2</upper><effort>3</effort><velocity>4</velocity></limit>
      <dynamics><damping>0.1</damping><friction>0.2</friction></dynamics>
    </axis>
  </joint>
  <link name="sledge">
    <pose relative_to="slide">0.5 0 0 0 0.1 0</pose>
    <inertial>
      <pose>0 0 -0.4 0 0.2 0</pose><mass>1</mass>
      <inertia><ixx>0.03</ixx><ixz>0.001</ixz><iyy>0.03</iyy><izz>0.02</izz></inertia>
    </inertial>
  </link>
</model></sdf>
"""
LUMPING = ("libsdformat", "pinocchio")
CHANGES = {
    "a mass": ('mass value="1"', 'mass value="1.001"', "other numbers"),
    "an inertia": ('ixx="0.03"', 'ixx="0.031"', "other numbers"),
    "a product of inertia": ('ixz="0.001"', 'ixz="0.002"', "other numbers"),
    "a center of mass": ('xyz="0 0 -0.4"', 'xyz="0 0.001 -0.4"', "other numbers"),
    "where a joint is": ('xyz="0 0.1 1"', 'xyz="0 0.1 1.001"', "other numbers"),
    "an axis": ('axis xyz="0 1 0"', 'axis xyz="0 -1 0"', "other numbers"),
    "a limit": ('upper="2"', 'upper="2.5"', "swing.upper 2 became 2.5"),
    "damping": ('damping="0.1"', 'damping="0.2"', "swing.damping 0.1 became 0.2"),
    "the name of a joint": ('"swing"', '"swings"', "joints lost: swing; joints added: swings"),
}


@pytest.fixture(params=sorted(oracles.ENGINES))
def engine(request: pytest.FixtureRequest) -> str:
    return present(request.param)


def present(engine: str) -> str:
    if not oracles.available(engine):
        pytest.skip(f"{engine} is not here: {oracles.ENGINES[engine].needs}")
    return engine


def written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def converted(source: Path, output: Path) -> Path:
    """The file in the other format; in the version that libsdformat 12 reads."""
    sdf = output.suffix == ".sdf"
    text = twinform.convert(source, to="sdf" if sdf else "urdf", sdf_version="1.9" if sdf else None).text
    return written(output, text)


def test_a_robot_is_the_same_as_itself(engine: str, tmp_path: Path):
    path = written(tmp_path / "a.urdf", ROBOT)
    verdict = oracles.compare(path, path, engine=engine)
    assert verdict
    assert verdict.alike is (oracles.Alike.LUMPED if engine in LUMPING else oracles.Alike.FRAMES)
    assert verdict.deviation == 0


_ASKED = [
    (engine, change)
    for (row, engine), (column, change) in product(enumerate(sorted(oracles.ENGINES)), enumerate(CHANGES))
    if DEEP or engine == "drake" or (row + column) % 3 == 0
]
"""Drake is asked of all changes, and every engine of each third, so that two or three engines see each of them."""


@pytest.mark.parametrize(("engine", "change"), _ASKED, indirect=["engine"])
def test_a_change_is_found_and_named(engine: str, change: str, tmp_path: Path):
    before, after, cause = CHANGES[change]
    a = written(tmp_path / "a.urdf", ROBOT)
    b = written(tmp_path / "b.urdf", ROBOT.replace(before, after))
    verdict = oracles.compare(a, b, engine=engine)
    assert not verdict
    assert cause in verdict.cause
    if cause == "other numbers":
        assert verdict.deviation > 1e-4
        assert verdict.of


def test_the_frame_of_a_link_is_judged_apart_from_its_mass(tmp_path: Path):
    a = written(tmp_path / "a.urdf", ROBOT)
    elsewhere = ROBOT.replace('<origin xyz="0 0 -1"/>', '<origin xyz="0 0 -1.5"/>').replace(
        '<mass value="0.5"/>', '<origin xyz="0 0 0.5"/><mass value="0.5"/>'
    )
    verdict = oracles.compare(a, written(tmp_path / "b.urdf", elsewhere), engine=present("drake"))
    assert verdict.alike is oracles.Alike.INERTIAL


def test_links_that_are_fixed_to_each_other_may_be_weighed_together(tmp_path: Path):
    a = written(tmp_path / "a.urdf", ROBOT)
    # the hand in two halves, one of them at the other's place
    inertia = 'ixx="0.005" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.005"'
    half = f'<link name="half"><inertial><mass value="0.25"/><inertia {inertia}/></inertial></link>'
    weld = '<joint name="weld" type="fixed"><parent link="hand"/><child link="half"/></joint>'
    halved = ROBOT.replace('value="0.5"', 'value="0.25"').replace('"0.01"', '"0.005"')
    b = written(tmp_path / "b.urdf", halved.replace("</robot>", f"{half}{weld}</robot>"))
    assert "links added: half" in oracles.compare(a, b, engine=present("drake")).cause
    assert oracles.compare(a, b, engine="drake", lumped=True).alike is oracles.Alike.LUMPED


def test_a_ball_joint_is_the_same_as_a_chain_of_three_that_begin_with_its_name(tmp_path: Path):
    hinge = '<joint name="{}" type="continuous"><parent link="{}"/><child link="{}"/><axis xyz="{}"/></joint>'
    chain = [
        hinge.format("socket_z", "base", "one", "0 0 1"),
        hinge.format("socket_y", "one", "two", "0 1 0"),
        hinge.format("socket", "two", "sledge", "1 0 0"),
        '<link name="one"/><link name="two"/>',
    ]
    inertia = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    link = '<link name="{}"><inertial><mass value="{}"/>' + inertia + "</inertial></link>"
    links = link.format("base", 2) + link.format("sledge", 1)
    urdf = written(tmp_path / "a.urdf", f"<robot name='r'>{links}{''.join(chain)}</robot>")
    sdf = """<sdf version="1.9"><model name="r">
      <link name="base"><inertial><mass>2</mass></inertial></link>
      <link name="sledge"><inertial><mass>1</mass></inertial></link>
      <joint name="socket" type="ball"><parent>base</parent><child>sledge</child></joint>
    </model></sdf>"""
    verdict = oracles.compare(written(tmp_path / "a.sdf", sdf), urdf, engine=present("drake"))
    assert verdict, verdict
    assert oracles.compare(urdf, tmp_path / "a.sdf")
    assert oracles.simulate(tmp_path / "a.sdf", urdf)


@pytest.mark.parametrize("name", ["arm", "rover"])
@pytest.mark.parametrize(("before", "after"), list(product(sorted(oracles.ENGINES), BOTH)))
def test_an_example_becomes_the_same_robot_in_sdf(before: str, after: str, name: str, tmp_path: Path):
    source = EXAMPLES / f"{name}.urdf"
    result = converted(source, tmp_path / "a.sdf")
    verdict = oracles.compare(source, result, engine=present(before), other=present(after))
    assert verdict, verdict


@pytest.mark.parametrize("after", sorted(set(oracles.ENGINES) - set(BOTH)))
@pytest.mark.parametrize("before", BOTH)
def test_sdf_becomes_the_same_robot_in_urdf(before: str, after: str, tmp_path: Path):
    source = written(tmp_path / "a.sdf", SDF)
    result = converted(source, tmp_path / "a.urdf")
    verdict = oracles.compare(source, result, engine=present(before), other=present(after))
    assert verdict, verdict


def test_an_engine_that_is_not_installed_is_an_error_with_the_remedy(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    path = written(tmp_path / "a.urdf", ROBOT)
    monkeypatch.setattr("twinform.testing.oracles.engines.find_spec", lambda _: None)  # pyright: ignore[reportUnknownLambdaType, reportUnknownArgumentType] - only its result matters
    assert not oracles.available("drake")
    assert not oracles.available()
    with pytest.raises(oracles.EngineMissingError, match=r"pip install 'twinform\[engines\]'"):
        oracles.compare(path, path)


def test_an_engine_that_does_not_exist_is_an_error_that_names_those_that_do():
    with pytest.raises(ValueError, match="there is no engine 'duck'; there are drake, libsdformat"):
        oracles.available("duck")


def test_a_format_that_the_engine_does_not_have_is_an_error(tmp_path: Path):
    path = written(tmp_path / "a.sdf", "<sdf version='1.9'/>")
    with pytest.raises(oracles.EngineUnreadableError, match=r"does not read \.sdf"):
        oracles.compare(path, path, engine=present("mujoco"))


def test_a_fault_in_one_file_is_an_error_with_its_name(engine: str, tmp_path: Path):
    good, bad = written(tmp_path / "a.urdf", ROBOT), written(tmp_path / "b.urdf", "<robot name='r'><link/>")
    with pytest.raises(oracles.EngineUnreadableError) as caught:
        oracles.compare(good, bad, engine=engine)
    assert caught.value.path == bad.resolve()


def test_the_end_of_the_child_is_an_error_and_not_the_end():
    with pytest.raises(ChildDiedError, match="ended with -9"):
        call(signal.raise_signal, signal.SIGKILL)


def test_a_child_that_does_not_come_back_is_given_up():
    with pytest.raises(ChildDiedError, match="no answer"):
        call(os.read, 0, 1, seconds=0.01)


def test_what_engines_print_is_not_in_the_way():
    assert call(os.write, 1, b"noise") == 5
