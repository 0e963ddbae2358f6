"""One way to change a tree: all of a class, once, from the inside out, and the same objects where nothing changes."""

from collections.abc import Callable
from typing import TypeVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.ir import (
    OPAQUE,
    Document,
    Element,
    GazeboExtension,
    Inertial,
    Joint,
    Link,
    Mesh,
    Model,
    Node,
    Plugin,
    Pose,
    Sensor,
    Visual,
    World,
    children_of,
    holds_opaque,
    map_children,
    replace_fields,
    replace_node,
    rewrite,
    walk,
)
from twinform.testing import strategies

pytestmark = pytest.mark.slow

AnyNode = TypeVar("AnyNode", bound=Node)

KINDS: tuple[type[Node], ...] = (
    Document, World, Model, Link, Joint, Visual, Inertial, Mesh, Pose, Sensor, Plugin, GazeboExtension, Node,
)  # fmt: skip
DOCUMENTS = strategies.robots() | strategies.sdf_models() | strategies.worlds()


def noted(seen: list[AnyNode]) -> Callable[[AnyNode], AnyNode]:
    """A change that changes nothing, and notes what it is asked about."""

    def change(node: AnyNode) -> AnyNode:
        seen.append(node)
        return node

    return change


def copied(node: AnyNode) -> AnyNode:
    return node.copy(opaque=node.opaque)


def ids(nodes: list[Node]) -> list[int]:
    return [id(node) for node in nodes]


def outside_last(node: Node) -> list[Node]:
    """All nodes in the order of their ends, as a plain recursion finds them."""
    return [*(each for child in children_of(node) for each in outside_last(child)), node]


@given(DOCUMENTS, st.sampled_from(KINDS))
def test_each_node_of_the_class_is_seen_once_from_the_inside_out(document: Document, kind: type[Node]) -> None:
    seen: list[Node] = []
    assert rewrite(document, kind, noted(seen)) is document
    assert ids(seen) == ids([node for node in outside_last(document) if isinstance(node, kind)])


@given(DOCUMENTS, st.sampled_from(KINDS))
def test_equal_copies_make_an_equal_tree(document: Document, kind: type[Node]) -> None:
    made = rewrite(document, kind, copied)
    assert made == document
    assert (made is document) == (not any(isinstance(node, kind) for node in walk(document)))


@given(DOCUMENTS, st.data())
def test_only_what_is_around_a_change_is_copied(document: Document, data: st.DataObject) -> None:
    old = data.draw(st.sampled_from([*walk(document)]))
    new = copied(old)
    made = replace_node(document, old, new)
    around = {id(node) for node in walk(document) if any(each is old for each in walk(node))}
    for before, after in zip(outside_last(document), outside_last(made), strict=True):
        assert (after is before) == (id(before) not in around)
    times = sum(each is old for each in walk(document))  # one object may stand in several places
    assert sum(each is new for each in walk(made)) == times


@given(DOCUMENTS)
def test_a_change_sees_what_was_changed_inside(document: Document) -> None:
    def renamed(model: Model) -> Model:
        assert all(inner.name.endswith("!") for inner in model.models)
        return model.copy(name=f"{model.name}!")

    made = rewrite(document, Model, renamed)
    assert all(node.name.endswith("!") for node in walk(made) if isinstance(node, Model))


@given(DOCUMENTS)
def test_copies_that_nothing_checks_are_those_that_validation_makes(document: Document) -> None:
    made = rewrite(document, Joint, lambda joint: joint.copy(pose=Pose(xyz=(1.0, 2.0, 3.0))))
    assert Document.model_validate(made.model_dump()) == made


@given(DOCUMENTS)
def test_what_is_not_entered_stays(document: Document) -> None:
    seen: list[Node] = []
    assert rewrite(document, Node, noted(seen), having=OPAQUE) is document
    assert ids(seen) == ids([node for node in outside_last(document) if holds_opaque(node)])


@given(DOCUMENTS)
def test_children_alone_are_asked_about(document: Document) -> None:
    seen: list[Node] = []
    assert map_children(document, noted(seen)) is document
    assert ids(seen) == ids([*children_of(document)])


def test_what_is_replaced_is_known_by_its_identity() -> None:
    model = Model(name="m", links=(Link(name="a"), Link(name="a")))
    made = replace_node(model, model.links[1], Link(name="b"))
    assert [link.name for link in made.links] == ["a", "b"]
    assert replace_node(model, Link(name="a"), Link(name="b")) is model


def test_a_field_with_the_same_objects_is_not_replaced() -> None:
    model = Model(name="m", links=(Link(name="a"), Link(name="b")))
    assert replace_fields(model, links=(*model.links,), joints=()) is model
    made = replace_fields(model, links=model.links[:1], joints=())
    assert made.links == model.links[:1]
    assert made.joints is model.joints
    element = Element(name="a", children=(Element(name="b"),))
    assert replace_fields(element, children=(*element.children,)) is element


def test_a_field_that_there_is_not_cannot_be_replaced() -> None:
    with pytest.raises(AttributeError):
        replace_fields(Link(name="a"), color=1)
