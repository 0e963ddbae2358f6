"""The generated writers of text write what lxml would write of the same tree, byte for byte."""

from contextlib import suppress
from pathlib import Path
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

import twinform
from tests.edits.strategies import xml_documents
from tests.profile import examples
from tests.written_text import assert_laid_out
from twinform.compiler.output.emitting import document_tree
from twinform.ir import Document, Element, Opaque, Pose
from twinform.ir.rewrite import rewrite
from twinform.schemas import XmlElement, element_xml, table
from twinform.testing import strategies

_CASES = Path(__file__).resolve().parents[1] / "cases"
_FILES = [path for folder in ("elements", "whole") for path in sorted((_CASES / folder).iterdir())]
_ODD = st.text(st.sampled_from("ab <>&\"'\t\n\r\u00e9\u2028\U0001f916"), max_size=8)
"""Strings with whatever has to be escaped, and with what must not be."""
_STRIPPED = _ODD.map(str.strip).filter(bool)
_NAMES = st.sampled_from(["a", "b", "{urn:known}a", "{urn:known}b", "{urn:unknown}a"])


@examples()
@given(strategies.robots() | strategies.sdf_models() | strategies.worlds())
def test_a_model_is_laid_out(model: Document) -> None:
    assert_laid_out(model)


@examples(0.3)
@given(strategies.robots(max_links=5))
def test_a_robot_in_sdf_is_laid_out(robot: Document) -> None:
    assert_laid_out(twinform.convert(robot, to="sdf").document)


@examples(0.3)
@given(strategies.sdf_models(max_links=5))
def test_a_model_in_urdf_is_laid_out(model: Document) -> None:
    assert_laid_out(twinform.convert(model, to="urdf").document)


@pytest.mark.parametrize("version", table("sdf").versions)
def test_every_version_is_laid_out(version: str) -> None:
    @examples(0.1)
    @given(xml_documents(version=version))
    def is_laid_out(text: bytes) -> None:
        document = twinform.check(text).document
        assert document is None or assert_laid_out(document)

    is_laid_out()


@examples(0.3)
@given(xml_documents(format="urdf"))
def test_urdf_that_the_schema_takes_is_laid_out(text: bytes) -> None:
    document = twinform.check(text).document
    assert document is None or assert_laid_out(document)


@st.composite
def _elements(draw: st.DrawFn, depth: int = 2) -> Element:
    children = draw(st.lists(_elements(depth - 1), max_size=2)) if depth else []
    texts = st.none() | _STRIPPED
    attributes = draw(st.lists(st.tuples(_NAMES, _ODD), max_size=2))
    return Element(
        name=draw(_NAMES), attributes=tuple(attributes), text=draw(texts), tail=draw(texts), children=tuple(children)
    )


def _opaques() -> st.SearchStrategy[Opaque]:
    at = st.sampled_from(["", "", "", "c", "c/d"])
    return (
        st.builds(Opaque, at=at, element=_elements())
        | st.builds(Opaque, at=at, attribute=st.tuples(_NAMES | st.just("name"), _ODD))
        | st.builds(Opaque, at=at, text=_STRIPPED)
    )


_NAMESPACES = st.sampled_from([(), (("k", "urn:known"),), (("k", "urn:known"), ("u", "urn:unknown"))])


@examples()
@given(
    strategies.robots(max_links=3) | strategies.sdf_models(max_links=3) | strategies.worlds(),
    st.lists(_opaques(), max_size=3),
    _ODD,
    _NAMESPACES,
)
def test_odd_parts_are_where_they_were(
    model: Document, parts: list[Opaque], name: str, namespaces: tuple[tuple[str, str], ...]
) -> None:
    def with_parts(pose: Pose) -> Pose:
        return pose.copy(opaque=tuple(parts))

    plain = model.copy(models=tuple(each.copy(name=name) for each in model.models), namespaces=namespaces)
    changed = plain.copy(models=tuple(each.copy(opaque=tuple(parts)) for each in plain.models))
    for document in (changed, rewrite(plain, Pose, with_parts)):
        _assert_laid_out_if_uniform(document)
    expected, seen = document_tree(plain), document_tree(changed)
    for holder in expected.iter("robot") if expected.tag == "robot" else expected.iterchildren("model"):
        _add(parts, holder)
    assert _content(seen) == _content(expected)


def _assert_laid_out_if_uniform(document: Document) -> None:
    """Prefixes that were made up may be declared elsewhere by lxml."""
    if any(prefix == "u" for prefix, _ in document.namespaces):
        assert_laid_out(document)


def _add(parts: list[Opaque], holder: XmlElement) -> None:
    for part in parts:
        place = holder
        for step in filter(None, part.at.split("/")):
            found = place.find(step)
            place = found if found is not None else etree.SubElement(place, step)
        if part.element is not None:
            element_xml(part.element, place)
        elif part.attribute is not None:
            place.set(*part.attribute)
        else:
            place.text = f"{place.text} {part.text}" if place.text else part.text


def _content(root: XmlElement) -> list[object]:
    return [(each.tag, sorted(each.attrib.items()), each.text, each.tail) for each in root.iter()]


_OTHER: dict[str, Literal["urdf", "sdf"]] = {".urdf": "sdf", ".sdf": "urdf"}


@pytest.mark.parametrize("path", _FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_a_case_is_laid_out(path: Path) -> None:
    document = twinform.check(path).document
    assert document is not None
    assert_laid_out(document)
    with suppress(twinform.CompileError):  # some hold no robot
        assert_laid_out(twinform.convert(path, to=_OTHER[path.suffix]).document)
