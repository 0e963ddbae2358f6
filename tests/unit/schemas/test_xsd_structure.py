"""What the XSDs take and refuse: elements, attributes, counts, versions, names."""

from functools import cache
from typing import NamedTuple

import pytest
import xmlschema
from lxml import etree

from twinform.schemas import Version, XmlElement, schema_text, table, xmlschema_errors
from twinform.schemas.xsd import generate_schema

pytestmark = pytest.mark.slow


class Case(NamedTuple):
    """A document of a version."""

    format: str
    version: Version
    text: str

    def replace(self, old: str, new: str) -> "Case":
        """The same with other text in one place."""
        assert self.text.count(old) == 1
        return self._replace(text=self.text.replace(old, new))


def _robot(inside: str, version: Version = (1, 0)) -> Case:
    return Case("urdf", version, f"<robot name='r' xmlns:x='urn:x'>{inside}</robot>")


def _sdf(inside: str, version: Version = (1, 12)) -> Case:
    return Case("sdf", version, f"<sdf version='1' xmlns:x='urn:x'>{inside}</sdf>")


def _shapes(inside: str) -> Case:
    return _sdf(
        f"<model name='m'><link name='l'><visual name='v'><geometry>{inside}</geometry></visual></link></model>"
    )


def _fog(inside: str) -> Case:
    return _sdf(f"<world name='w'><scene><fog>{inside}</fog></scene></world>")


_LINKS = "<link name='a'/><link name='b'/>"
_ARM = _robot(f"{_LINKS}<joint name='j' type='fixed'><child link='b'/><parent link='a'/></joint>")
_CAPSULE = "<link name='l'><visual><geometry><capsule radius='1' length='1'/></geometry></visual></link>"
_TWINS = "<link name='l'/><link name='l'/>"

TAKEN = {
    "children in any order": _ARM,
    "foreign elements": _robot(f"<x:a><link/>text</x:a>{_LINKS}"),
    "a root in a foreign element": _robot(f"<x:a><robot/></x:a>{_LINKS}"),
    "foreign attributes": _robot("<link name='a' x:name='b'/>"),
    "attributes of XML": _robot("<link name='a' xml:space='odd' xml:lang='?'/>"),
    "a link and a joint of one name": _ARM.replace("'j'", "'a'"),
    "a mimic": _ARM.replace("</joint>", "<mimic joint='j'/></joint>"),
    "free content": _robot(f"{_LINKS}<gazebo odd='1'>text<a b='c'><link/></a><robot/></gazebo>"),
    "an element in its version": _robot(_CAPSULE, (1, 1)),
    "an attribute that became optional": _ARM._replace(version=(1, 2)).replace("</joint>", "<limit/></joint>"),
    "a shape": _shapes("<box><size>1 1 1</size></box>"),
    "no shape": _shapes(""),
    "two polylines": _shapes("<polyline/><x:a/><polyline/>"),
    "a shape among foreign elements": _shapes("<x:a/><plane/><x:a/><x:a/>"),
    "blank leaves": _sdf("<model name='m'><static/><pose> </pose></model>"),
    "a padded word": _fog("<type> linear\n</type>"),
    "a foreign attribute of a word": _fog("<type x:y='1'>linear</type>"),
    "a pose in a frame": _sdf("<model name='m'><pose relative_to='f' degrees='True'>1 2 3 4 5 6</pose></model>"),
    "equal names in nested models": _sdf(
        "<model name='m'><link name='l'/><model name='m'><link name='l'/><model name='m'><link name='l'/></model>"
        "</model><model name='n'><link name='l'/></model></model>"
    ),
    "plugins of one name": _sdf(
        "<model name='m'><plugin name='p' filename='f'/><plugin name='p' filename='f'/></model>"
    ),
    "an SDF 1.5 model without links": _sdf("<model name='m'/>", (1, 5)),
}

TAKEN_BY_THE_PROJECTION = {
    "no link": _robot(""),
    "no parent": _ARM.replace("<parent link='a'/>", ""),
    "two parents": _ARM.replace("<parent link='a'/>", "<parent link='a'/><parent link='a'/>"),
    "two links of one name": _robot(_TWINS),
    "a parent that is no link": _ARM.replace("<parent link='a'/>", "<parent link='c'/>"),
    "a mimic of no joint": _ARM.replace("</joint>", "<mimic joint='k'/></joint>"),
    "two shapes": _shapes("<box/><sphere/>"),
    "two of a shape": _shapes("<box/><box/>"),
    "a polyline and a box": _shapes("<polyline/><box/>"),
    "equal names in a model": _sdf(f"<model name='m'>{_TWINS}</model>"),
    "equal names in a nested model": _sdf(
        f"<model name='m'><link name='l'/><model name='m'><link name='k'/><model name='m'>{_TWINS}</model>"
        "</model></model>"
    ),
    "equal names around a nested model": _sdf(
        "<model name='m'><link name='l'/><model name='m'><link name='l'/></model><link name='l'/></model>"
    ),
}

ASSERTED = {
    "a revolute joint without limits": _ARM.replace("fixed", "revolute"),
    "a prismatic joint without limits": _ARM.replace("fixed", "prismatic"),
    "a geometry without a shape": _robot("<link name='l'><visual><geometry/></visual></link>"),
    "a shape of a negative size": _robot(
        "<link name='l'><visual><geometry><box size='1 -1 1'/></geometry></visual></link>"
    ),
    "a shape of a negative radius": _robot(
        "<link name='l'><visual><geometry><sphere radius='-1'/></geometry></visual></link>"
    ),
    "a transmission of nothing": _robot(f"{_LINKS}<transmission name='t'/>"),
    "a transmission without a type": _robot(f"{_LINKS}<transmission name='t'><joint name='j'/></transmission>"),
    "a box without a size": _shapes("<box/>"),
    "a negative radius": _shapes("<sphere><radius> -1e-3 </radius></sphere>"),
    "a negative size": _shapes("<box><size>1 1 -1</size></box>"),
    "a light without a type": _sdf("<light name='l'/>"),
    "noise without a type": _sdf(
        "<model name='m'><link name='l'><sensor name='s' type='altimeter'><altimeter><vertical_position><noise/>"
        "</vertical_position></altimeter></sensor></link></model>"
    ),
    "a link that is called world": _sdf("<model name='m'><link name='world'/></model>"),
    "a name between underlines": _sdf("<model name='__m__'><link name='l'/></model>"),
    "a name with a scope": _sdf("<model name='m'><link name='a::b'/></model>"),
}
"""What only assertions refuse."""

NOT_ASSERTED = {
    "a revolute joint with a limit": _ARM.replace("fixed", "revolute").replace(
        "</joint>", "<limit effort='1' velocity='1'/></joint>"
    ),
    "a continuous joint": _ARM.replace("fixed", "continuous"),
    "a foreign shape": _robot("<link name='l'><visual><geometry><x:torus/></geometry></visual></link>"),
    "a shape of size zero": _robot(
        "<link name='l'><visual><geometry><box size=' 0  -0 1e-9 '/></geometry></visual></link>"
    ),
    "a sphere without a radius": _shapes("<sphere/>"),
    "a blank radius": _shapes("<sphere><radius/></sphere>"),
    "a transmission": _robot(
        f"{_LINKS}<transmission name='t'><type>x</type><joint name='j'/><actuator name='a'/></transmission>"
    ),
    "an old transmission": _robot(f"{_LINKS}<transmission name='t' type='x'><actuator name='a'/></transmission>"),
    "names before there were any reserved ones": _sdf("<model name='__m__'><link name='world'/></model>", (1, 6)),
    "a scope in a name before there were any": _sdf("<model name='m'><link name='a::b'/></model>", (1, 7)),
    "a name with underlines": _sdf("<model name='__m'><link name='l__'/></model>"),
    "a plugin between underlines": _sdf("<model name='m'><link name='l'/><plugin name='__p__' filename='f'/></model>"),
}

REFUSED = {
    "an unknown element": _robot(f"{_LINKS}<links/>"),
    "an unknown attribute": _robot("<link name='a' mass='1'/>"),
    "a missing attribute": _robot("<link/>"),
    "text between elements": _robot(f"{_LINKS} text"),
    "text in an element without children": _robot(f"{_LINKS}<material><color rgba='1 1 1 1'>red</color></material>"),
    "an unknown word": _ARM.replace("fixed", "welded"),
    "a padded word in an attribute": _ARM.replace("fixed", " fixed"),
    "a typed attribute of a free element": _robot(f"{_LINKS}<sensor name='s' update_rate='often'/>"),
    "an element of a later version": _robot(_CAPSULE),
    "an attribute that was required": _ARM.replace("</joint>", "<limit/></joint>"),
    "a blank word": _fog("<type/>"),
    "an unknown attribute of a word": _fog("<type y='1'>linear</type>"),
    "a foreign element in a leaf": _sdf("<model name='m'><static>true<x:a/></static></model>"),
}


@pytest.mark.parametrize(
    "case", [*TAKEN.values(), *TAKEN_BY_THE_PROJECTION.values()], ids=[*TAKEN, *TAKEN_BY_THE_PROJECTION]
)
def test_the_projection_takes(case: Case):
    assert _verdicts_of_the_projection(case) == [True, True]


@pytest.mark.parametrize("case", REFUSED.values(), ids=REFUSED)
def test_the_projection_refuses(case: Case):
    assert _verdicts_of_the_projection(case) == [False, False]


@pytest.mark.parametrize("case", TAKEN.values(), ids=TAKEN)
def test_the_normative_schema_takes(case: Case):
    assert _normative(case).is_valid(_root(case))


@pytest.mark.parametrize(
    "case",
    [*(REFUSED | TAKEN_BY_THE_PROJECTION).values()],
    ids=[*(REFUSED | TAKEN_BY_THE_PROJECTION)],
)
def test_the_normative_schema_refuses(case: Case):
    assert not _normative(case).is_valid(_root(case))


@pytest.mark.parametrize("case", [*TAKEN.values(), *NOT_ASSERTED.values()], ids=[*TAKEN, *NOT_ASSERTED])
def test_no_assertion_is_in_the_way(case: Case):
    assert xmlschema_errors(_root(case), case.format, case.version, assertions=True) == []


@pytest.mark.parametrize("case", ASSERTED.values(), ids=ASSERTED)
def test_assertions_refuse(case: Case):
    assert not _normative(case).is_valid(_root(case))
    assert xmlschema_errors(_root(case), case.format, case.version) == []
    assert len(xmlschema_errors(_root(case), case.format, case.version, assertions=True)) == 1
    assert _verdicts_of_the_projection(case) == [True, True]


LENIENT: dict[str, Case] = {
    "an element of a later version": _robot(_CAPSULE),
    "an attribute of a later version": _robot(
        "<link name='l'><visual><origin quat_xyzw='0 0 0 1'/><geometry><sphere radius='1'/></geometry></visual></link>"
    ),
    "a word of a later version": _sdf(
        "<model name='m'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent>a</parent>"
        "<child>b</child></joint></model>",
        (1, 5),
    ),
    "an element of a dialect": _robot(f"{_LINKS}<mujoco><compiler meshdir='x'/></mujoco>"),
    "an attribute of a dialect": _robot("<link name='a' drake_ignore='true'/>"),
    "a word of a dialect": _ARM.replace("fixed", "spherical"),
    "an unknown attribute": _robot("<link name='a' odd='1'/>"),
    "foreign attributes and elements": _robot("<link name='a' x:odd='1'><x:y/></link>"),
}
"""What readers of real files come across."""

LENIENT_IN_XSD_1_1 = {
    "an unknown element": _robot(f"{_LINKS}<odd><link/>text</odd>"),
    "an unknown element in a shape": _shapes("<torus><radius>1</radius></torus>"),
    "an unknown element where there are none": _robot("<link name='a'><inertial><mass value='1'><odd/></mass>"
    "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"),
}  # fmt: skip

REFUSED_BY_LENIENT = {
    name: REFUSED[name]
    for name in ("a missing attribute", "an unknown word", "a typed attribute of a free element", "a blank word")
}


@pytest.mark.parametrize("case", [*TAKEN.values(), *LENIENT.values()], ids=[*TAKEN, *LENIENT])
def test_a_lenient_schema_takes(case: Case):
    assert _lenient_verdicts(case) == [True, True, True]


@pytest.mark.parametrize("case", LENIENT_IN_XSD_1_1.values(), ids=LENIENT_IN_XSD_1_1)
def test_only_xsd_1_1_takes_unknown_elements(case: Case):
    assert _lenient_verdicts(case) == [False, False, True]


@pytest.mark.parametrize("case", REFUSED_BY_LENIENT.values(), ids=REFUSED_BY_LENIENT)
def test_a_lenient_schema_refuses(case: Case):
    assert _lenient_verdicts(case) == [False, False, False]


def _lenient_verdicts(case: Case) -> list[bool]:
    """Those of libxml2 and xmlschema by XSD 1.0, and of xmlschema by XSD 1.1."""
    projection, newer = _lenient_schemas(case.format, case.version)
    return [
        etree.XMLSchema(etree.fromstring(projection.encode())).validate(_root(case)),
        _reference(projection).is_valid(_root(case)),
        newer.is_valid(_root(case)),
    ]


@cache
def _lenient_schemas(name: str, version: Version) -> tuple[str, xmlschema.XMLSchema11]:
    facts = table(name)
    newer = generate_schema(facts, version, "1.1", lenient=True)
    return generate_schema(facts, version, "1.0", lenient=True), xmlschema.XMLSchema11(newer, allow="none")


def _root(case: Case) -> XmlElement:
    return etree.fromstring(case.text)


def _verdicts_of_the_projection(case: Case) -> list[bool]:
    schema = schema_text(case.format, case.version, "1.0")
    return [
        etree.XMLSchema(etree.fromstring(schema.encode())).validate(_root(case)),
        _reference(schema).is_valid(_root(case)),
    ]


@cache
def _reference(schema: str) -> xmlschema.XMLSchema10:
    return xmlschema.XMLSchema10(schema, allow="none")


@cache
def _normative_schema(name: str, version: Version) -> xmlschema.XMLSchema11:
    return xmlschema.XMLSchema11(schema_text(name, version), allow="none")


def _normative(case: Case) -> xmlschema.XMLSchema11:
    return _normative_schema(case.format, case.version)
