"""What is found once about a node holds for every copy of it."""

from typing import Any

from hypothesis import given

from twinform.ir import Document, Element, GazeboExtension, Link, Node, Opaque, Visual, holds_opaque, walk
from twinform.ir.record import Sourced
from twinform.testing import strategies

OPAQUE = Opaque(element=Element(name="{urn:x}mark"))


def _is_there(node: Node) -> bool:
    return any(each.opaque or isinstance(each, GazeboExtension) for each in walk(node))


@given(strategies.robots())
def test_what_a_walk_finds_is_found(robot: Document) -> None:
    for node in walk(robot):
        assert holds_opaque(node) == _is_there(node)
        assert holds_opaque(node) == _is_there(node), "the second time it is remembered"


def test_a_copy_is_asked_for_itself() -> None:
    link = Link(name="a", visuals=(Visual(name="v"),))
    assert not holds_opaque(link)
    with_opaque = link.copy(visuals=(Visual(name="v", opaque=(OPAQUE,)),))
    assert holds_opaque(with_opaque)
    assert not holds_opaque(with_opaque.copy(visuals=()))


@given(strategies.robots())
def test_unchecked_parts_are_those_that_validation_makes(robot: Document) -> None:
    for node in walk(robot):
        values: dict[str, Any] = {name: getattr(node, name) for name in node.field_names}
        made: Sourced = type(node).unchecked(**values)
        assert made == node
        assert made.model_dump() == node.model_dump()
