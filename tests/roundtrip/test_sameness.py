"""What holds for every comparison of robots, tried on models that Hypothesis makes up."""

from collections.abc import Callable
from contextlib import nullcontext
from unittest.mock import patch

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import twinform
from tests.mutations import MUTATIONS, OF_SDF, OF_URDF, mutate
from tests.profile import examples
from twinform import Comparison
from twinform.compiler.compare.readers import Memo
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.testing import strategies

pytestmark = pytest.mark.slow

_SETTINGS = examples(0.5)
_FEW = examples(0.05)


def _text(document: Document) -> bytes:
    return emit(document, DiagnosticSink()).encode()


def _messages(comparison: Comparison) -> list[str]:
    return [item.message for item in comparison.differences]


def _make(memo: Memo, key: object, given: object, make: Callable[[], object], *_: object) -> object:
    del memo, key, given
    return make()


@pytest.mark.parametrize("read", ["once", "twice"])
@_SETTINGS
@given(strategies.robots() | strategies.sdf_models())
def test_a_robot_is_itself_without_a_note(read: str, model: Document):
    # what is read once for both files has to be what a comparison of all of it finds
    with nullcontext() if read == "once" else patch.object(Memo, "once", _make):
        assert twinform.diff(_text(model), _text(model)).items == ()


@_SETTINGS
@given(strategies.robots())
def test_a_robot_and_its_sdf_are_the_same(robot: Document):
    text = _text(robot)
    assert _messages(twinform.diff(text, twinform.convert(text, to="sdf").text.encode(), carriers=True)) == []


@_SETTINGS
@given(strategies.sdf_models())
def test_a_model_and_its_urdf_are_the_same(model: Document):
    text = _text(model)
    assert _messages(twinform.diff(text, twinform.convert(text, to="urdf").text.encode(), carriers=True)) == []


@_SETTINGS
@given(strategies.robots(max_links=4), strategies.sdf_models(max_links=4))
def test_the_order_of_the_files_does_not_matter(one: Document, other: Document):
    there, back = twinform.diff(_text(one), _text(other)), twinform.diff(_text(other), _text(one))
    assert there.same == back.same
    assert len(there.differences) == len(back.differences)


@pytest.mark.parametrize("mutation", [name for name in MUTATIONS if name not in OF_SDF])
@_FEW
@given(robot=strategies.robots(max_links=4))
def test_a_change_of_a_robot_is_found_in_both_formats(mutation: str, robot: Document):
    changed = mutate(robot, mutation)
    assume(changed is not None)
    assert changed is not None
    one, other = _text(robot), _text(changed)
    assert not twinform.diff(one, other).same
    assert not twinform.diff(other, one).same
    assert not twinform.diff(twinform.convert(one, to="sdf").text.encode(), other).same


@pytest.mark.parametrize("mutation", [name for name in MUTATIONS if name not in OF_URDF])
@_FEW
@given(model=strategies.sdf_models(max_links=4))
def test_a_change_of_a_model_is_found(mutation: str, model: Document):
    changed = mutate(model, mutation)
    assume(changed is not None)
    assert changed is not None
    assert not twinform.diff(_text(model), _text(changed)).same
    assert not twinform.diff(_text(changed), _text(model)).same


@_SETTINGS
@given(strategies.robots(max_links=4), st.sampled_from(["link_0", "joint_1"]))
def test_another_name_is_found(robot: Document, name: str):
    text = _text(robot)
    assume(f'"{name}"'.encode() in text and b"floating" not in text)
    assert not twinform.diff(text, text.replace(f'"{name}"'.encode(), b'"renamed"')).same
