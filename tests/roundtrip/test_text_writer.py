"""The generated writers of text write what the tree writer writes, byte for byte."""

from contextlib import suppress
from pathlib import Path
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.edits.strategies import xml_documents
from tests.profile import examples
from twinform.compiler.output.emitting import document_tree, serialized, text_without_tree
from twinform.ir import Document, Element, Opaque, Pose
from twinform.ir.rewrite import rewrite
from twinform.schemas import table
from twinform.testing import strategies

_CASES = Path(__file__).resolve().parents[1] / "cases"
_FILES = [path for folder in ("elements", "whole") for path in sorted((_CASES / folder).iterdir())]
_ODD = st.text(st.sampled_from("ab <>&\"'\t\n\r\u00e9\u2028\U0001f916"), max_size=8)
"""Strings with whatever has to be escaped, and with what must not be."""
_NAMES = st.sampled_from(["a", "b", "{urn:known}a", "{urn:known}b", "{urn:unknown}a"])


def _assert_same(document: Document) -> str | None:
    text = text_without_tree(document)
    assert text is None or text == serialized(document_tree(document), document)
    return text


def _assert_written(document: Document) -> None:
    assert _assert_same(document) is not None


@examples()
@given(strategies.robots() | strategies.sdf_models() | strategies.worlds())
def test_a_model_is_written_as_by_the_tree_writer(model: Document) -> None:
    _assert_written(model)


@examples(0.3)
@given(strategies.robots(max_links=5))
def test_a_robot_in_sdf_is_written_as_by_the_tree_writer(robot: Document) -> None:
    _assert_written(twinform.convert(robot, to="sdf").document)


@examples(0.3)
@given(strategies.sdf_models(max_links=5))
def test_a_model_in_urdf_is_written_as_by_the_tree_writer(model: Document) -> None:
    _assert_written(twinform.convert(model, to="urdf").document)


@pytest.mark.parametrize("version", table("sdf").versions)
def test_every_version_is_written_as_by_the_tree_writer(version: str) -> None:
    @examples(0.1)
    @given(xml_documents(version=version))
    def is_written(text: bytes) -> None:
        document = twinform.check(text).document
        assert document is None or _assert_same(document) != ""

    is_written()


@examples(0.3)
@given(xml_documents(format="urdf"))
def test_urdf_that_the_schema_takes_is_written_as_by_the_tree_writer(text: bytes) -> None:
    document = twinform.check(text).document
    assert document is None or _assert_same(document) != ""


@st.composite
def _elements(draw: st.DrawFn, depth: int = 2) -> Element:
    children = draw(st.lists(_elements(depth - 1), max_size=2)) if depth else []
    texts = st.none() | _ODD
    attributes = draw(st.lists(st.tuples(_NAMES, _ODD), max_size=2))
    return Element(
        name=draw(_NAMES), attributes=tuple(attributes), text=draw(texts), tail=draw(texts), children=tuple(children)
    )


def _opaques() -> st.SearchStrategy[Opaque]:
    at = st.sampled_from(["", "", "", "a", "a/b"])
    return (
        st.builds(Opaque, at=at, element=_elements())
        | st.builds(Opaque, at=at, attribute=st.tuples(_NAMES | st.just("name"), _ODD))
        | st.builds(Opaque, at=at, text=_ODD)
    )


@examples()
@given(
    strategies.robots(max_links=3) | strategies.sdf_models(max_links=3) | strategies.worlds(),
    st.lists(_opaques(), max_size=3),
    _ODD,
    st.sampled_from([(), (("k", "urn:known"),), (("k", "urn:known"), ("u", "urn:unknown"))]),
)
def test_odd_parts_are_written_as_by_the_tree_writer(
    model: Document, parts: list[Opaque], name: str, namespaces: tuple[tuple[str, str], ...]
) -> None:
    def with_parts(pose: Pose) -> Pose:
        return pose.copy(opaque=tuple(parts))

    models = [each.copy(name=name, opaque=tuple(parts)) for each in model.models]
    changed = model.copy(models=tuple(models), namespaces=namespaces)
    for document in (changed, rewrite(model.copy(namespaces=namespaces), Pose, with_parts)):
        _assert_same(document)


_OTHER: dict[str, Literal["urdf", "sdf"]] = {".urdf": "sdf", ".sdf": "urdf"}


@pytest.mark.parametrize("path", _FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_a_case_is_written_as_by_the_tree_writer(path: Path) -> None:
    document = twinform.check(path).document
    assert document is not None
    _assert_same(document)
    with suppress(twinform.CompileError):  # some hold no robot
        _assert_same(twinform.convert(path, to=_OTHER[path.suffix]).document)
