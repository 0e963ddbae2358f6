"""The text of documents, and the findings of its tree where the schema refuses it."""

from typing import Any

import pytest
from lxml import etree

import twinform
from twinform.compiler.output import emitting
from twinform.compiler.output.emitting import document_text, document_tree, emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Element, Format, Frame, Link, Model, Opaque
from twinform.schemas import is_valid_text

ROBOT = b"""<robot name="r">
  <link name="a"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
  <link name="b"/>
</robot>"""


def _sdf(*models: Model, **fields: Any) -> Document:
    return Document.unchecked(format=Format.SDF, version="1.11", models=models, **fields)


@pytest.mark.parametrize("name", ["r", "a & b", "\u00e9", "\u4e16", "\U0001f916"])
def test_a_valid_document_needs_no_tree(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    document = twinform.loads(ROBOT)
    document = document.copy(models=(document.models[0].copy(name=name),))
    monkeypatch.setattr(emitting, "_parse_text", None)
    assert etree.fromstring(emit(document, DiagnosticSink())).get("name") == name


def test_a_document_that_the_schema_refuses_has_the_findings_of_its_tree() -> None:
    sink = DiagnosticSink()
    emit(_sdf(Model(name="m", opaque=(Opaque(element=Element(name="static", text="what")),))), sink)
    assert [found.rule.name for found in sink.diagnostics] == ["invalid-value"]


@pytest.mark.parametrize("name", ["a\x00", "a\x1f", "\ufffe"])
def test_what_xml_cannot_hold_is_refused_as_ever(name: str) -> None:
    with pytest.raises(ValueError, match="XML compatible"):
        emit(_sdf(Model(name=name)), DiagnosticSink())


@pytest.mark.parametrize("untyped", [(), (Opaque(attribute=("version", "7")),)])
def test_a_version_stands_behind_the_attributes_of_a_robot(untyped: tuple[Opaque, ...]) -> None:
    document = twinform.loads(ROBOT).copy(version="1.1")
    document = document.copy(models=(document.models[0].copy(opaque=untyped),))
    assert '<robot name="r" version="1.1">' in document_text(document)


def test_a_default_namespace_stands_behind_the_others() -> None:
    namespaces = (("", "urn:a&b"), ("k", "urn:k"))
    text = document_text(_sdf(Model(name="m", links=(Link(name="a"),)), namespaces=namespaces))
    assert '<sdf xmlns:k="urn:k" xmlns="urn:a&amp;b" version="1.11">' in text
    assert "<model" in text


def test_frames_of_robots_stand_behind_untyped_links_too() -> None:
    document = twinform.convert(ROBOT, to="sdf").document
    link = Opaque(element=Element(name="link", attributes=(("name", "x"),)))
    frames = (Frame(name="g", attached_to="f"), Frame(name="f", attached_to="x"))
    changed = document.copy(models=(document.models[0].copy(frames=frames, opaque=(link,)),))
    assert [each.get("name") for each in document_tree(changed)[0]][-3:] == ["x", "f", "g"]


def test_frames_of_untyped_models_in_what_comes_from_urdf_are_put_in_order() -> None:
    document = twinform.convert(ROBOT, to="sdf").document
    frame = Element(name="frame", attributes=(("name", "f"), ("attached_to", "a")))
    model = Element(name="model", children=(frame, Element(name="link", attributes=(("name", "a"),))))
    changed = document.copy(opaque=(Opaque(element=Element(name="population", children=(model,))),))
    assert [each.tag for each in document_tree(changed).iterfind("population/model/*")] == ["link", "frame"]


def test_a_tree_has_the_lines_of_untyped_elements_alone_and_no_layout() -> None:
    document = twinform.loads(ROBOT.replace(b"</robot>", b"<gazebo>\n<x>\n<y/>\n</x>\n</gazebo>\n</robot>"))
    tree = document_tree(document)
    assert [(each.tag, each.sourceline) for each in tree.iter() if each.sourceline] == [("x", 6), ("y", 7)]
    assert {each.text for each in tree.iter()} == {each.tail for each in tree.iter()} == {None}


VALID = '<?xml version="1.0"?>\n<sdf version="1.11"><model name="m"><link name="a"/></model></sdf>\n'


def test_text_is_valid_if_it_is_xml_that_the_schema_accepts() -> None:
    assert is_valid_text(VALID, "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("link", "what"), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace(' name="a"', ""), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("<link", "<static>7</static><link"), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("</sdf>", ""), "sdf", (1, 11))
    assert is_valid_text(VALID, "sdf", (1, 11))
