"""What the generated writers of text leave to the tree writer, and what makes them."""

from dataclasses import replace

import pytest

from twinform.ir import Document, Element, Format, Inertial, Link, Model, Opaque, Plugin, Pose
from twinform.schemas import parse_version, root_text, table
from twinform.schemas.facts import parse_facts
from twinform.schemas.text_generator import generate_text_writer

_KNOWN = {"k": "urn:known"}


def _written(model: Model, version: str = "1.12", namespaces: dict[str | None, str] | None = None) -> str | None:
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
    assert text is not None
    assert '<sdf xmlns:k="urn:known" version="1.12">' in text
    assert '    <k:a k:b="c"/>\n' in text


@pytest.mark.parametrize("name", ["{urn:unknown}a", "a b", "a:b", "", "1"])
def test_a_name_that_is_not_plain_needs_a_tree(name: str) -> None:
    assert _written(_with_element(Element(name=name)), namespaces={**_KNOWN}) is None


def test_two_prefixes_of_a_namespace_need_a_tree() -> None:
    assert _written(Model(name="m"), namespaces={"k": "urn:known", "l": "urn:known"}) is None


def test_elements_that_are_too_deep_need_a_tree() -> None:
    deep = Element(name="a")
    for _ in range(2000):
        deep = Element.unchecked(name="a", children=(deep,))
    assert _written(_with_element(deep)) is None


def test_what_stands_between_elements_is_left_as_it_is() -> None:
    plugin = Plugin(name="p", filename="f", content=(Element(name="a", tail="text"), Element(name="b")))
    text = _written(Model(name="m", plugins=(plugin,)))
    assert text is not None
    assert '    <plugin name="p" filename="f">\n      <a/>text<b/>\n    </plugin>\n' in text


def test_a_row_is_written_as_its_version_has_it() -> None:
    model = Model(name="m", links=(Link(name="a", inertial=Inertial(pose=Pose(xyz=(1, 0, 0), relative_to="b"))),))
    before, after = (_written(model, version) for version in ("1.7", "1.8"))
    assert before is not None
    assert after is not None
    assert '<pose relative_to="b">1 0 0 0 0 0</pose>' in before
    assert "<pose>1 0 0 0 0 0</pose>" in after


@pytest.mark.parametrize(
    ("spelt", "written"), [("1", "1"), (" TRUE\n", " TRUE\n"), ("false", "true"), ("\r1", "&#13;1")]
)
def test_a_truth_value_is_spelt_as_it_was_where_it_is_the_same(spelt: str, written: str) -> None:
    text = _written(Model(name="m", static=True, spelling={"static": spelt}))
    assert text is not None
    assert f"<static>{written}</static>" in text


def test_a_part_of_a_definition_can_be_written_as_a_tree() -> None:
    text = _written(Model(name="m", links=(Link(name="a", inertial=Inertial(mass=1, opaque=_inside("mass"))),)))
    assert text is not None
    assert '      <inertial>\n        <mass b="c">1</mass>\n      </inertial>\n' in text


def _inside(at: str) -> tuple[Opaque, ...]:
    return (Opaque(at=at, attribute=("b", "c")),)


def test_what_versions_write_in_two_ways_is_refused_where_there_is_no_template_for_it() -> None:
    rows = """
urdf
  a  ?  double  until=1.1  -> a
  a  ?  bool    since=1.2  -> a
"""
    definitions = {fact.name: fact for fact in parse_facts(rows.splitlines(), "test")}
    with pytest.raises(ValueError, match="urdf: a is written in two ways"):
        generate_text_writer(replace(table("urdf"), root="urdf", definitions=definitions))
