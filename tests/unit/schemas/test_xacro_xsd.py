"""The XSDs of xacro files, asked through libxml2 and xmlschema."""

from pathlib import Path

import pytest
import xmlschema
from lxml import etree

from twinform.schemas.facts import table
from twinform.schemas.xacro_xsd import ELEMENTS, NAMESPACES, imported_schemas, unambiguous
from twinform.schemas.xsd import generate_schema

NAMESPACE = NAMESPACES[0]
URDF = [
    (True, '<link name="${prefix}a"/>'),
    (True, '<joint name="j" type="${kind}"><axis xyz="0 0 ${z}"/></joint>'),
    (True, '<xacro:property name="a" value="1"/><xacro:if value="${a}"><link name="b"/></xacro:if>'),
    (True, '<xacro:macro name="m" params="n *b"><link name="${n}"><xacro:insert_block name="b"/></link></xacro:macro>'),
    (True, '<xacro:m n="a"><origin xyz="0 0 0"/></xacro:m>'),
    (True, '<xacro:element xacro:name="link" name="a" other="1"/>'),
    (True, "<gazebo><xacro:plugin_of_mine/><anything/></gazebo>"),
    (True, '<xacro:macro name="looks" params=""><gazebo><material>Gazebo/Red</material></gazebo></xacro:macro>'),
    (False, '<link name="a" /><axle/>'),
    (False, '<joint name="j" type="hinge"/>'),
    (False, '<joint name="j" type="revolute"><axis xyz="0 0 z"/></joint>'),
    (False, '<xacro:propertie name="a"/><xacro:property nam="a"/>'),
    (False, '<xacro:if><link name="b"/></xacro:if>'),
    (False, '<xacro:if value="1"><link name="b"><visal/></link></xacro:if>'),
    (
        False,
        '<xacro:macro name="m"><xacro:if value="1"><origin xyz="0"/></xacro:if></xacro:macro>',
    ),
]
SDF = [
    (True, '<model name="${m}"><link name="a"><pose>0 0 ${h/2} 0 0 0</pose></link></model>'),
    (True, '<model name="m"><xacro:unless value="$(arg x)"><static>${s}</static></xacro:unless></model>'),
    (True, '<model name="m"><joint name="j" type="${t}"><parent>a</parent></joint></model>'),
    (True, '<world name="w"><physics type="${engine}"><max_step_size>${s}</max_step_size></physics></world>'),
    (False, '<model name="m"><link name="a"><pose>0 0 h 0 0 0</pose></link></model>'),
    (False, '<model name="m"><xacro:if value="1"><link name="a"><pos/></link></xacro:if></model>'),
]


@pytest.fixture(scope="module", params=["urdf", "sdf"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The schemas of a format in a folder of its name."""
    format = str(request.param)
    made = tmp_path_factory.mktemp(format) / format
    made.mkdir()
    facts = table(format)
    main = generate_schema(facts, facts.newest, "1.0", xacro=True)
    for name, text in {"main.xsd": main, **imported_schemas()}.items():
        (made / name).write_text(text, encoding="utf-8")
    return made


def test_what_is_taken_and_what_is_refused(folder: Path) -> None:
    schema = etree.XMLSchema(etree.parse(folder / "main.xsd"))
    root, cases = ("robot", URDF) if folder.name == "urdf" else ('sdf version="1.12"', SDF)
    for namespace in NAMESPACES:
        texts = [f'<{root} xmlns:xacro="{namespace}">{inside}</{root.split()[0]}>' for _, inside in cases]
        assert [(bool(schema.validate(etree.fromstring(text))), text) for text in texts] == [
            (good, text) for (good, _), text in zip(cases, texts, strict=True)
        ]


def test_another_engine_reads_them_too(folder: Path) -> None:
    schema = xmlschema.XMLSchema10(str(folder / "main.xsd"))
    assert schema.built
    assert {f"{{{NAMESPACE}}}{each.name}" for each in ELEMENTS} <= set(schema.maps.elements)


def test_every_element_and_attribute_says_what_it_is(folder: Path) -> None:
    schema = etree.parse(folder / "xacro-www.ros.org.xsd")
    nothing = schema.xpath(
        "//xs:*[self::xs:element or self::xs:attribute[@name]][not(xs:annotation/xs:documentation/text())]",
        namespaces={"xs": "http://www.w3.org/2001/XMLSchema"},
    )
    assert nothing == []


def test_macros_of_urdf_may_hold_sdf() -> None:
    names = {name for name, _ in unambiguous(table("urdf"), table("urdf").newest)}
    assert "link" in names
    assert not names & {"material", "visual", "joint"}
