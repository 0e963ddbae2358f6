"""Drake counts the same freedoms and kilograms."""

from pathlib import Path

import pytest

from twinform.compiler import LoadOptions, read
from twinform.compiler.statistics import measure
from twinform.ir import Axis, walk

_EXAMPLES = Path(__file__).parents[2] / "examples"
_ROBOTS = ("arm.urdf", "rover.urdf", "four_wheels.urdf", "sensor_base.urdf", "crate/model.sdf")


@pytest.mark.parametrize("name", _ROBOTS)
def test_freedoms_and_mass_are_those_that_drake_finds(name: str) -> None:
    plants = pytest.importorskip("pydrake.multibody.plant")
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    plant = plants.MultibodyPlant(0.0)
    parser = parsing.Parser(plant)
    parser.package_map().Add("twinform_arm", str(_EXAMPLES / "twinform_arm"))
    parser.AddModels(str(_EXAMPLES / name))
    plant.Finalize()
    reading = LoadOptions()
    checked = read(_EXAMPLES / name, reading)
    assert checked.document
    (found,) = measure(checked, checked.document, reading.search, meshes=False).models
    following = sum(isinstance(each, Axis) and each.mimic is not None for each in walk(checked.document))
    assert plant.num_velocities() - 6 * len(plant.GetFloatingBaseBodies()) == found.dof + following
    assert plant.CalcTotalMass(plant.CreateDefaultContext()) == pytest.approx(found.mass, abs=1e-9)
