"""Every element and attribute has a meaning in words, and the schemas say it."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from lxml import etree

from twinform.compiler.output.json import is_array, is_object, json_schema_text
from twinform.schemas import parse_version, schema_text, table
from twinform.schemas.meanings import Documentation, meanings, rows_with_paths, unmatched
from twinform.schemas.packaged import XsdVersion
from twinform.schemas.xsd_values import XS

FORMATS = ("urdf", "sdf", "mjcf")


@pytest.mark.parametrize("name", FORMATS)
def test_every_row_has_one_and_every_one_a_row(name: str) -> None:
    assert unmatched(name) == (set(), set())


@pytest.mark.parametrize("name", FORMATS)
def test_meanings_are_sentences(name: str) -> None:
    odd = {path: text for path, text in meanings(name).items() if not (text[0].isupper() or text[0].isdigit())}
    odd |= {path: text for path, text in meanings(name).items() if not text.endswith(".") or "  " in text}
    assert odd == {}


@pytest.mark.parametrize("xsd", ["1.0", "1.1"])
@pytest.mark.parametrize("name", FORMATS)
def test_every_element_and_attribute_of_a_schema_is_documented(name: str, xsd: XsdVersion) -> None:
    for version in map(parse_version, table(name).versions):
        schema = etree.fromstring(schema_text(name, version, xsd).encode())
        inner = [each for each in schema.iter(XS + "element", XS + "attribute") if each.getparent() is not schema]
        assert [each.get("name") for each in inner if not each.findtext(f"{XS}annotation/{XS}documentation")] == []
        types = [
            each for each in schema.iterchildren(XS + "complexType") if not str(each.get("name")).endswith("-leaf")
        ]
        assert [each.get("name") for each in types if each.find(XS + "annotation") is None] == []


def test_every_field_of_the_json_schema_is_documented() -> None:
    schema = json.loads(json_schema_text())
    fields = list(_fields(schema))
    assert len(fields) > 300
    assert [name for name, field in fields if not field.get("description")] == []


def test_units_defaults_and_versions_are_documented() -> None:
    words = Documentation(table("sdf"))
    rows = dict(rows_with_paths(table("sdf")))
    sentence = words.of(("inertial", "density"), rows["inertial", "density"])
    assert sentence.endswith("Unit: kg/m^3. Default: 1000. Since SDF 1.11.")
    old = words.of(("physics", "update_rate"), rows["physics", "update_rate"])
    assert old.endswith("Unit: Hz. Default: 1000. Until SDF 1.3.")
    ranged = words.of(("noise", "stddev"), rows["noise", "stddev"])
    assert "At least 0." in ranged
    assert "From 0 to 1." in words.of(("light", "diffuse"), rows["light", "diffuse"])
    assert words.of(("joint", "thread_pitch"), rows["joint", "thread_pitch"]).endswith("Deprecated.")


def test_what_a_value_names_is_documented() -> None:
    words = Documentation(table("mjcf"))
    rows = dict(rows_with_paths(table("mjcf")))
    sentence = words.of(("frame_sensor", "@objname"), rows["frame_sensor", "@objname"])
    assert sentence == "The name of the object. The name of a body, geom, site or camera."
    sensor = words.of(("actuator_sensor", "@actuator"), rows["actuator_sensor", "@actuator"])
    assert sensor == "The actuator. The name of an actuator."


def _fields(data: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    if is_array(data):
        for each in data:
            yield from _fields(each)
    elif is_object(data):
        if is_object(data.get("properties")):
            yield from data["properties"].items()
        for each in data.values():
            yield from _fields(each)
