"""Inertias that SDF leaves to its reader: numbers in URDF, and left to the reader again in SDF."""

import importlib
from pathlib import Path
from typing import Any

import pytest

import twinform
from twinform.ir import Inertial

ROBOT = """<sdf version='1.11'><model name='m'><link name='a'/>
<link name='b'><pose>1 0 0 0 0 0.5</pose>{}</link>
<joint name='j' type='revolute'><pose>0 0 0.25 0.1 0 0</pose><parent>a</parent><child>b</child></joint>
</model></sdf>"""
BOX = "<collision name='c'>{}<pose>0 0 0.5 0 0.3 0</pose><geometry><box><size>1 2 3</size></box></geometry></collision>"
CONE = "<collision name='d'><density>700</density><geometry><cone/></geometry></collision>"
AUTO = "<inertial auto='true'>{}</inertial>"
DENSE = "<density>500</density>"
WRITTEN = "<pose>1 1 1 0 0 0</pose><inertia><ixx>9</ixx></inertia>"


def urdf(inside: str, *, carriers: bool = True) -> str:
    return twinform.convert(ROBOT.format(inside).encode(), to="urdf", carriers=carriers).text


def inertial(text: str) -> Inertial:
    found = twinform.loads(text).models[0].links[1].inertial
    assert found
    return found


@pytest.mark.parametrize(
    ("inside", "mass"),
    [
        (AUTO.format("") + BOX.format(""), 6000.0),
        (AUTO.format(DENSE) + BOX.format(""), 3000.0),
        (AUTO.format(DENSE) + BOX.format("<density>2000</density>"), 12000.0),
        (AUTO.format("<mass>3</mass>") + BOX.format(""), 3.0),
        (AUTO.format(WRITTEN) + BOX.format(""), 6000.0),
    ],
)
def test_the_collisions_and_their_densities_give_the_mass(inside: str, mass: float):
    assert inertial(urdf(inside)).mass == pytest.approx(mass)


def test_an_inertia_that_is_not_automatic_stays_as_it_is_written():
    made = inertial(urdf("<inertial auto='false'><mass>2</mass></inertial>" + BOX.format("")))
    assert made.mass == 2
    assert made.inertia
    assert made.inertia.ixx == 1


@pytest.mark.parametrize(
    "inside",
    [
        AUTO.format("") + BOX.format(""),
        AUTO.format(DENSE) + BOX.format("<density>2000</density>"),
        AUTO.format("<mass>3</mass>" + DENSE) + BOX.format(""),
        AUTO.format(WRITTEN) + BOX.format(""),
        AUTO.format("") + BOX.format("") + CONE,
        AUTO.format("<auto_inertia_params><voxels>3</voxels></auto_inertia_params>") + BOX.format(""),
    ],
)
def test_it_is_automatic_again_on_the_way_back(inside: str):
    made = twinform.convert(urdf(inside).encode(), to="sdf")
    assert "stale-carrier" not in [each.rule.name for each in made.diagnostics]
    assert "massless-link" not in [each.rule.name for each in made.diagnostics]
    assert inertial(made.text) == inertial(ROBOT.format(inside))


@pytest.mark.parametrize(("old", "new"), [('mass value="6000"', 'mass value="5"'), ('size="1 2 3"', 'size="1 2 4"')])
def test_edited_numbers_or_shapes_are_not_automatic_any_more(old: str, new: str):
    text = urdf(AUTO.format("") + BOX.format(""))
    assert old in text
    made = twinform.convert(text.replace(old, new).encode(), to="sdf")
    assert "stale-carrier" in [each.rule.name for each in made.diagnostics]
    assert inertial(made.text).auto is None
    assert inertial(made.text).mass in (5, 6000)


def test_an_sdf_that_cannot_express_it_has_the_numbers():
    text = urdf(AUTO.format("") + BOX.format(""))
    assert inertial(twinform.convert(text.encode(), to="sdf", sdf_version="1.9").text).mass == pytest.approx(6000)


def test_without_carriers_only_the_numbers_are_left():
    text = urdf(AUTO.format(DENSE) + BOX.format(""), carriers=False)
    assert "twinform" not in text
    assert inertial(twinform.convert(text.encode(), to="sdf").text).mass == pytest.approx(3000)


@pytest.mark.parametrize(
    ("inside", "words"),
    [
        (AUTO.format(""), "no collision"),
        (AUTO.format("") + "<collision name='p'><geometry><plane/></geometry></collision>", "a plane"),
        (AUTO.format("") + "<collision name='p'/>", "no shape"),
    ],
)
def test_what_has_no_inside_is_an_error_at_its_line(inside: str, words: str):
    with pytest.raises(twinform.CompileError) as caught:
        urdf(inside)
    errors = [each for each in caught.value.diagnostics if each.is_error]
    assert [each.rule.name for each in errors] == ["automatic-inertia"]
    assert words in errors[0].message
    assert errors[0].location.line == 2


WEDGE = "<collision name='w'><density>300</density><geometry><mesh><uri>wedge.stl</uri></mesh></geometry></collision>"


@pytest.fixture
def wedge(tmp_path: Path) -> Path:
    """A model of SDF beside the mesh of a box of 1 x 2 x 3 m."""
    trimesh: Any = importlib.import_module("trimesh")
    trimesh.creation.box((1, 2, 3)).export(tmp_path / "wedge.stl")
    path = tmp_path / "model.sdf"
    path.write_text(ROBOT.format(AUTO.format("") + WEDGE))
    return path


def test_a_mesh_beside_the_model_gives_what_the_box_gives(wedge: Path):
    box = WEDGE.replace("<mesh><uri>wedge.stl</uri></mesh>", "<box><size>1 2 3</size></box>")
    made, expected = inertial(twinform.convert(wedge, to="urdf").text), inertial(urdf(AUTO.format("") + box))
    assert made.mass == pytest.approx(expected.mass)
    assert made.inertia
    assert expected.inertia
    for moment in ("ixx", "iyy", "izz"):
        assert getattr(made.inertia, moment) == pytest.approx(getattr(expected.inertia, moment))


def test_a_mesh_is_looked_into_on_the_way_back_too(wedge: Path):
    there = wedge.with_suffix(".urdf")
    there.write_text(twinform.convert(wedge, to="urdf").text)
    back = twinform.convert(there, to="sdf")
    assert [each.rule.name for each in back.diagnostics if each.severity > 1] == []
    assert inertial(back.text) == inertial(wedge.read_text())
    there.write_text(there.read_text().replace('mass value="1800"', 'mass value="5"'))
    assert "stale-carrier" in [each.rule.name for each in twinform.convert(there, to="sdf").diagnostics]


def test_a_mesh_in_an_sdf_before_1_11_is_written_out(wedge: Path):
    assert inertial(twinform.convert(wedge, to="sdf", sdf_version="1.10").text).mass == pytest.approx(1800)


def test_a_mesh_that_is_not_found_is_an_error(wedge: Path):
    wedge.with_name("wedge.stl").unlink()
    with pytest.raises(twinform.CompileError, match=r"wedge\.stl.* is not found"):
        twinform.convert(wedge, to="urdf")
