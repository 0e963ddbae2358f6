"""Nodes are frozen, know their fields, and are validated where their values come from people."""

import pickle
from copy import deepcopy
from dataclasses import FrozenInstanceError
from typing import Any

import pytest
from hypothesis import given
from pydantic import BaseModel, ValidationError

import twinform
from twinform.diagnostics import Source
from twinform.ir import Box, Document, Geometry, Inertial, Link, Node, Pose, Visual, walk
from twinform.ir.geometry import ShapeNode
from twinform.ir.record import Sourced, field_values, fields_of, record, required_fields
from twinform.testing import strategies

from .kinds import kinds

LINK = Link(name="base", inertial=Inertial(mass=1.0), visuals=(Visual(geometry=Geometry(shape=Box())),))


KINDS = {kind.__name__: kind for kind in kinds() if kind not in {Sourced, ShapeNode}}
GIVEN: dict[str, Any] = {"name": "a", "type": "fixed", "format": "sdf"}


@pytest.mark.parametrize("name", sorted(KINDS))
def test_all_ways_to_make_a_part_make_the_same(name: str) -> None:
    kind = KINDS[name]
    values = {name: GIVEN[name] for name in required_fields(kind)}
    made = kind(**values)
    others = {
        "checked data": kind.model_validate(values),
        "JSON": kind.model_validate_json(made.model_dump_json()),
        "dump": kind.model_validate(made.model_dump()),
        "no check": kind.unchecked(**field_values(made)),
        "copy": made.copy(),
        "replace": made.replace(**values),
        "pickle": pickle.loads(pickle.dumps(made)),
        "deepcopy": deepcopy(made),
    }
    for way, other in others.items():
        assert type(other) is kind, way
        assert other == made, way
        assert hash(other) == hash(made), way
        assert repr(other) == repr(made), way
        assert [type(getattr(other, each)) for each in fields_of(kind)] == [
            type(getattr(made, each)) for each in fields_of(kind)
        ], way


@given(strategies.robots() | strategies.worlds())
def test_a_whole_document_is_the_same_from_json_and_pickle(document: Document) -> None:
    assert Document.model_validate_json(document.model_dump_json()) == document
    restored = pickle.loads(pickle.dumps(document))
    assert restored == document
    assert [node.source for node in walk(restored)] == [node.source for node in walk(document)]


def test_values_are_validated() -> None:
    with pytest.raises(ValidationError, match="valid number"):
        Inertial(mass="heavy")  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValidationError, match="valid number"):
        Inertial(mass=1.0).replace(mass="heavy")
    with pytest.raises(ValidationError, match="Field required"):
        Link()  # pyright: ignore[reportCallIssue]
    with pytest.raises(ValidationError, match="does not match any of the expected tags"):
        Geometry.model_validate({"shape": {"kind": "torus"}})
    with pytest.raises(ValidationError, match="source"):
        Link.model_validate_json('{"name": "a", "source": "x"}')


def test_a_misspelt_field_is_an_error_in_every_way() -> None:
    wrong: dict[str, Any] = {"inertal": None}
    with pytest.raises(ValidationError, match="Unexpected keyword argument"):
        LINK.replace(**wrong)
    with pytest.raises(AttributeError, match="'Link' object has no attribute 'inertal'"):
        LINK.copy(**wrong)
    with pytest.raises(AttributeError, match="inertal"):
        LINK.copy(**wrong)
    with pytest.raises(TypeError, match="Link has no field inertal"):
        Link.unchecked(name="a", **wrong)
    with pytest.raises(TypeError, match="Link lacks name"):
        Link.unchecked(**wrong)
    with pytest.raises(ValidationError, match="Unexpected keyword argument"):
        Link(name="a", **wrong)


def test_replace_validates_and_copy_does_not() -> None:
    values: dict[str, Any] = {"mass": 12}
    assert type(Inertial().replace(**values).mass) is float
    assert type(Inertial().copy(**values).mass) is int


def test_a_node_is_frozen() -> None:
    for part in (LINK, Link.unchecked(name="a"), LINK.copy(name="b"), Link.model_validate({"name": "a"})):
        with pytest.raises(FrozenInstanceError, match="use replace"):
            part.name = "c"  # pyright: ignore[reportAttributeAccessIssue]
        with pytest.raises(FrozenInstanceError):
            del part.name  # pyright: ignore[reportAttributeAccessIssue]


def test_where_it_was_read_and_how_it_was_spelt_is_no_part_of_equality() -> None:
    elsewhere = LINK.copy(source=Source("a.urdf", 3, None, "robot"), spelling={"gravity": "1"})
    assert elsewhere == LINK
    assert hash(elsewhere) == hash(LINK)
    assert "source" not in elsewhere.model_dump()


def test_absent_is_not_default() -> None:
    assert Pose() != Pose(xyz=(0.0, 0.0, 0.0))
    assert Pose.unchecked(degrees=False) != Pose()


def test_equal_values_of_another_class_are_not_equal() -> None:
    assert Pose() != Inertial()


def test_repr_is_one_short_line() -> None:
    assert repr(LINK) == "Link(name='base', inertial=Inertial(...), visuals=<1 Visual>)"
    document = twinform.load("examples/rover.urdf")
    assert repr(document) == "Document(format=<Format.URDF: 'urdf'>, models=<1 Model>)"
    assert all(len(repr(node)) < 400 and "\n" not in repr(node) for node in walk(document))


def test_a_node_is_a_field_of_a_model_of_somebody_else() -> None:
    class Mine(BaseModel):
        link: Link

    assert Mine.model_validate({"link": {"name": "a"}}).link == Link(name="a")
    assert "Link" in Mine.model_json_schema()["$defs"]


def test_a_class_without_the_decorator_is_refused() -> None:
    class Mine(Node):
        color: str | None = None

    with pytest.raises(TypeError, match="Mine needs the decorator `record`"):
        Mine.unchecked()


def test_a_class_of_somebody_else_is_a_node() -> None:
    @record
    class Mine(Node):
        color: str | None = None

    assert Mine(color="red").replace(color="blue") == Mine.unchecked(color="blue")
