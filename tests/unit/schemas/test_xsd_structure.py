"""What the XSDs take and refuse: elements, attributes, counts, versions, names."""

from functools import cache
from typing import NamedTuple

import pytest
import xmlschema
from lxml import etree

from twinform.schemas import Version, XmlElement, schema_text


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
    "a shape": _shapes("<box/>"),
    "no shape": _shapes(""),
    "two polylines": _shapes("<polyline/><x:a/><polyline/>"),
    "a shape among foreign elements": _shapes("<x:a/><box/><x:a/><x:a/>"),
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
    "an SDF 1.4 model without links": _sdf("<model name='m'/>", (1, 4)),
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
