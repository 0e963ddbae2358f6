"""The generated writers of text, and what makes them."""

from dataclasses import replace
from textwrap import dedent

import pytest
from lxml import etree

import twinform
from generators.text_writers import generate_text_writer
from twinform.ir import Document, Element, Format, Inertial, Link, Model, Opaque, Plugin, Pose
from twinform.schemas import WrittenParts, node_xml, parse_version, root_text, table
from twinform.schemas.facts import parse_facts

_KNOWN = {"k": "urn:known"}


def _written(model: Model, version: str = "1.12", namespaces: dict[str | None, str] | None = None) -> str:
    document = Document(format=Format.SDF, version=version, models=(model,))
    return root_text("sdf", parse_version(version), document, namespaces or {})


def _with_element(element: Element) -> Model:
    return Model(name="m", opaque=(Opaque(element=element),))


def test_a_file_has_a_head_and_two_blanks_for_each_level() -> None:
    model = Model(name="m", links=(Link(name="a", pose=Pose(xyz=(1, 0.5, 1e-7))), Link(name="b")))
    assert _written(model) == (
        '<?xml version="1.0"?>\n<sdf version="1.12">\n  <model name="m">\n    <link name="a">\n'
        '      <pose>1 0.5 1e-07 0 0 0</pose>\n    </link>\n    <link name="b"/>\n  </model>\n</sdf>\n'
    )


def test_namespaces_are_those_of_the_root() -> None:
    text = _written(
        _with_element(Element(name="{urn:known}a", attributes=(("{urn:known}b", "c"),))), namespaces={**_KNOWN}
    )
    assert '<sdf xmlns:k="urn:known" version="1.12">' in text
    assert '    <k:a k:b="c"/>\n' in text


@pytest.mark.parametrize("name", ["a b", "a:b", "", "1", "{urn:known}"])
def test_what_is_no_name_is_refused(name: str) -> None:
    for element in (Element.unchecked(name=name), Element.unchecked(name="a", attributes=((name, ""),))):
        with pytest.raises(ValueError, match="tag name"):
            _written(_with_element(element), namespaces={**_KNOWN})


@pytest.mark.parametrize("text", ["\0", "a\x1f", "\ufffe", "\ud800"])
def test_what_xml_cannot_hold_is_refused(text: str) -> None:
    for element in (Element(name="a", text=text), Element(name="a", attributes=(("b", text),))):
        with pytest.raises(ValueError, match="XML compatible"):
            _written(_with_element(element))


def test_of_two_prefixes_of_a_namespace_the_first_is_used() -> None:
    text = _written(_with_element(Element(name="{urn:known}a")), namespaces={"k": "urn:known", "l": "urn:known"})
    assert '<sdf xmlns:k="urn:known" xmlns:l="urn:known" version' in text
    assert "<k:a/>" in text


@pytest.mark.parametrize(
    ("element", "written"),
    [
        (Element(name="{urn:v}a", children=(Element(name="{urn:v}b"),)), '<a xmlns="urn:v">\n      <b/>\n    </a>'),
        (
            Element(name="{urn:v}a", children=(Element(name="b"),)),
            '<ns0:a xmlns:ns0="urn:v">\n      <b/>\n    </ns0:a>',
        ),
        (Element(name="{urn:v}a", attributes=(("{urn:v}b", "c"),)), '<ns0:a xmlns:ns0="urn:v" ns0:b="c"/>'),
        (Element(name="a", attributes=(("{urn:v}b", "c"),)), '<a xmlns:ns0="urn:v" ns0:b="c"/>'),
    ],
)
def test_a_namespace_without_a_prefix_is_declared_where_it_is_used(element: Element, written: str) -> None:
    assert f"\n    {written}\n" in _written(_with_element(element))


def test_a_made_up_prefix_is_none_of_the_document() -> None:
    model = Model(name="m", opaque=(Opaque(attribute=("{urn:v}b", "c")),))
    assert '<model xmlns:ns1="urn:v" name="m" ns1:b="c"/>' in _written(model, namespaces={"ns0": "urn:k"})


def test_what_stands_between_elements_is_left_as_it_is() -> None:
    plugin = Plugin(name="p", filename="f", content=(Element(name="a", tail="text"), Element(name="b")))
    text = _written(Model(name="m", plugins=(plugin,)))
    assert '    <plugin name="p" filename="f">\n      <a/>text<b/>\n    </plugin>\n' in text


def test_a_row_is_written_as_its_version_has_it() -> None:
    model = Model(name="m", links=(Link(name="a", inertial=Inertial(pose=Pose(xyz=(1, 0, 0), relative_to="b"))),))
    before, after = (_written(model, version) for version in ("1.7", "1.8"))
    assert '<pose relative_to="b">1 0 0 0 0 0</pose>' in before
    assert "<pose>1 0 0 0 0 0</pose>" in after


@pytest.mark.parametrize(
    ("spelt", "written"), [("1", "1"), (" TRUE\n", " TRUE\n"), ("false", "true"), ("\r1", "&#13;1")]
)
def test_a_truth_value_is_spelt_as_it_was_where_it_is_the_same(spelt: str, written: str) -> None:
    text = _written(Model(name="m", static=True, spelling={"static": spelt}))
    assert f"<static>{written}</static>" in text


@pytest.mark.parametrize(
    ("parts", "written"),
    [
        ([Opaque(at="mass", attribute=("b", "c"))], '<mass b="c">1</mass>'),
        ([Opaque(at="mass", attribute=(name, "c")) for name in "bb"], '<mass b="c">1</mass>'),
        ([Opaque(at="mass", text="2"), Opaque(at="mass", text="3")], "<mass>1 2 3</mass>"),
        ([Opaque(at="mass", element=Element(name="b"))], "<mass>1<b/>\n  </mass>"),
        ([Opaque(at="b/c", element=Element(name="d"))], "<mass>1</mass>\n  <b>\n    <c>\n      <d/>\n    </c>\n  </b>"),
        ([Opaque(text="2")], None),
        ([Opaque(element=Element(name="b", tail="2")), Opaque(at="c", text="3")], "<mass>1</mass>\n  <b/>2<c>3</c>"),
    ],
)
def test_untyped_parts_stand_where_they_stood(parts: list[Opaque], written: str | None) -> None:
    link = Link(name="a", inertial=Inertial(mass=1, opaque=tuple(parts)))
    text = _written(Model(name="m", links=(link,))).partition('<link name="a">\n')[2].partition("\n    </link>")[0]
    found = dedent(text)
    assert found == (f"<inertial>\n  {written}\n</inertial>" if written else "<inertial>2<mass>1</mass>\n</inertial>")


def test_a_node_alone_is_written_without_layout() -> None:
    inside = Opaque(element=Element(name="a", children=(Element(name="b"),)))
    parts = (inside, Opaque(at="b", attribute=("c", "d")), Opaque(at="mass", element=Element(name="e")))
    xml = node_xml("sdf", Inertial(mass=1, opaque=parts), "inertial")
    written = '<inertial><mass>1<e/></mass><a><b/></a><b c="d"/></inertial>'
    assert etree.tostring(xml, encoding="unicode") == written


def test_an_element_that_is_empty_is_there_where_it_is_asked_for() -> None:
    assert node_xml("sdf", Pose(), "pose").tag == "pose"


def test_parts_are_led_to_their_elements() -> None:
    document = twinform.loads(
        '<robot name="r"><link name="a"><inertial><mass value="1"/></inertial></link><x/></robot>'
    )
    parts: WrittenParts = []
    text = root_text("urdf", (1, 0), document.models[0], {}, parts=parts)
    assert text == root_text("urdf", (1, 0), document.models[0], {})
    tags = ["<robot ", "<link ", "<inertial>", "<x/>"]
    assert [text[start:].startswith(tag) for (_, start), tag in zip(parts, tags, strict=True)] == [True] * 4
    assert [type(part).__name__ for part, _ in parts] == ["Model", "Link", "Inertial", "Opaque"]


def test_what_versions_write_in_two_ways_is_refused_where_there_is_no_template_for_it() -> None:
    rows = """
urdf
  a  ?  double  until=1.1  -> a
  a  ?  bool    since=1.2  -> a
"""
    definitions = {fact.name: fact for fact in parse_facts(rows.splitlines(), "test")}
    with pytest.raises(ValueError, match="urdf: a is written in two ways"):
        generate_text_writer(replace(table("urdf"), root="urdf", definitions=definitions))
