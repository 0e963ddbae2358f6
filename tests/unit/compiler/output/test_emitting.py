"""The text of documents: without a tree where that is possible, and with the findings of the tree where it is not."""

from typing import Any

import pytest

import twinform
from twinform.compiler.output import emitting
from twinform.compiler.output.emitting import document_tree, emit, serialized, text_without_tree
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Element, Format, Link, Model, Opaque
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
    text = serialized(document_tree(document), document)
    monkeypatch.setattr(emitting, "document_tree", None)
    assert emit(document, DiagnosticSink()) == text


def test_a_document_that_the_schema_refuses_has_the_findings_of_its_tree() -> None:
    sink = DiagnosticSink()
    emit(_sdf(Model(name="m", opaque=(Opaque(element=Element(name="static", text="what")),))), sink)
    assert [found.rule.name for found in sink.diagnostics] == ["invalid-value"]


@pytest.mark.parametrize("name", ["a\x00", "a\x1f", "\ufffe"])
def test_what_xml_cannot_hold_is_refused_as_ever(name: str) -> None:
    with pytest.raises(ValueError, match="XML compatible"):
        emit(_sdf(Model(name=name)), DiagnosticSink())


def test_a_version_stands_behind_the_attributes_of_a_robot() -> None:
    document = twinform.loads(ROBOT).copy(version="1.1")
    text = text_without_tree(document)
    assert text == serialized(document_tree(document), document)
    assert text is not None
    assert '<robot name="r" version="1.1">' in text


def test_a_robot_with_a_version_and_untyped_attributes_needs_a_tree() -> None:
    document = twinform.loads(ROBOT)
    model = document.models[0].copy(opaque=(Opaque(attribute=("version", "7")),))
    changed = document.copy(version="1.1", models=(model,))
    assert text_without_tree(changed) is None
    assert text_without_tree(changed.copy(version=None)) is not None


def test_a_default_namespace_needs_a_tree() -> None:
    assert text_without_tree(_sdf(Model(name="m", links=(Link(name="a"),)), namespaces=(("", "urn:a"),))) is None


def test_untyped_models_in_what_comes_from_urdf_need_a_tree() -> None:
    document = twinform.convert(ROBOT, to="sdf").document
    assert text_without_tree(document) is not None
    population = Opaque(element=Element(name="population", children=(Element(name="model"),)))
    assert text_without_tree(document.copy(opaque=(population,))) is None
    model = document.models[0].copy(opaque=(Opaque(element=Element(name="link")),))
    assert text_without_tree(document.copy(models=(model,))) is None


VALID = '<?xml version="1.0"?>\n<sdf version="1.11"><model name="m"><link name="a"/></model></sdf>\n'


def test_text_is_valid_if_it_is_xml_that_the_schema_accepts() -> None:
    assert is_valid_text(VALID, "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("link", "what"), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace(' name="a"', ""), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("<link", "<static>7</static><link"), "sdf", (1, 11))
    assert not is_valid_text(VALID.replace("</sdf>", ""), "sdf", (1, 11))
    assert is_valid_text(VALID, "sdf", (1, 11))
