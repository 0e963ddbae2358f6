"""Drake lets two models go from one state and reports whether they move alike."""

from pathlib import Path

import pytest

import twinform
from twinform.testing import oracles

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[3] / "examples"
# hangs free in space, swings, and is damped
ROBOT = """<robot name="kite">
  <link name="body">
    <inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1.2" iyz="0" izz="1.1"/></inertial>
  </link>
  <joint name="tail_joint" type="continuous">
    <parent link="body"/><child link="tail"/>
    <origin xyz="0 0.1 1" rpy="0.1 0 0"/><axis xyz="0 1 0"/><dynamics damping="0.1"/>
  </joint>
  <link name="tail">
    <inertial>
      <origin xyz="0 0 -0.4"/><mass value="1"/>
      <inertia ixx="0.03" ixy="0" ixz="0.001" iyy="0.03" iyz="0" izz="0.02"/>
    </inertial>
  </link>
</robot>
"""
CHANGES = {
    "a mass": ('mass value="1"', 'mass value="1.001"'),
    "a product of inertia": ('ixz="0.001"', 'ixz="0.002"'),
    "damping": ('damping="0.1"', 'damping="0.11"'),
    "an axis": ('axis xyz="0 1 0"', 'axis xyz="0 -1 0"'),
}


@pytest.fixture(autouse=True)
def drake() -> None:
    if not oracles.available("drake"):
        pytest.skip(f"drake is not here: {oracles.ENGINES['drake'].needs}")


def written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", ["arm", "rover"])
def test_an_example_moves_as_it_does_in_sdf_and_back_in_urdf(name: str, tmp_path: Path):
    source = EXAMPLES / f"{name}.urdf"
    sdf = written(tmp_path / "a.sdf", twinform.convert(source, to="sdf").text)
    urdf = written(tmp_path / "a.urdf", twinform.convert(sdf, to="urdf").text)
    for verdict in (oracles.simulate(source, sdf), oracles.simulate(sdf, urdf)):
        assert verdict.alike is oracles.Alike.MOTION, verdict
        assert verdict.deviation < 1e-9


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_makes_it_move_otherwise(change: str, tmp_path: Path):
    a = written(tmp_path / "a.urdf", ROBOT)
    verdict = oracles.simulate(a, written(tmp_path / "b.urdf", ROBOT.replace(*CHANGES[change])))
    assert not verdict
    assert verdict.deviation > 1e-6
    assert "moves otherwise" in verdict.cause


def test_joints_that_only_one_of_them_has_are_named(tmp_path: Path):
    a = written(tmp_path / "a.urdf", ROBOT)
    verdict = oracles.simulate(a, written(tmp_path / "b.urdf", ROBOT.replace("tail_joint", "tail_hinge")))
    assert verdict.cause == "only the first has joint tail_joint; only the second has joint tail_hinge"


def test_a_model_that_cannot_be_simulated_is_an_error_with_its_name(tmp_path: Path):
    massless = written(tmp_path / "a.urdf", ROBOT.partition('<link name="tail">')[0] + '<link name="tail"/></robot>')
    with pytest.raises(oracles.EngineUnreadableError) as caught:
        oracles.simulate(massless, massless)
    assert caught.value.path == massless.resolve()
