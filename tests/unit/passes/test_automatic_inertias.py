"""Inertias that SDF leaves to its reader: numbers in URDF, and left to the reader again in SDF."""

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


def test_an_sdf_that_cannot_say_it_has_the_numbers():
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
