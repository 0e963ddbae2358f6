"""Frames stand behind what they are attached to, in a tree and in text."""

import pytest
from lxml import etree

from twinform.compiler.output.bases_first import has_untyped_names, parts_with_bases_first, put_bases_first
from twinform.ir import Element, Frame, Link, Model, Node, Opaque, Pose
from twinform.schemas import Item, NeedsTree


def _write(node: Node, out: object, indent: str) -> str:
    raise NotImplementedError


_PARTS = {
    "c": (Frame(name="c", attached_to="b"), '<frame name="c" attached_to="b"/>'),
    "b": (Frame(name="b", attached_to="a::x"), '<frame name="b" attached_to="a::x"/>'),
    "d": (
        Frame(name="d", pose=Pose(relative_to="a")),
        '<frame name="d"><pose relative_to="a"/></frame>',
    ),
    "a": (Link(name="a"), '<link name="a"/>'),
    "e": (Frame(name="e", attached_to="e"), '<frame name="e" attached_to="e"/>'),
    "f": (Frame(name="f", attached_to="elsewhere"), '<frame name="f" attached_to="elsewhere"/>'),
}


def _of_nodes(order: str) -> str:
    model = Model(name="m", frames=tuple(node for node, _ in _PARTS.values() if isinstance(node, Frame)))
    parts: list[Item] = [(_PARTS[name][0], _write) for name in order]
    return "".join(node.name for node, _ in parts_with_bases_first(model, parts))


def _of_elements(order: str) -> str:
    model = etree.fromstring(f"<model>{''.join(_PARTS[name][1] for name in order)}<static/></model>")
    put_bases_first(model)
    return "".join(child.get("name") or "-" for child in model)


@pytest.mark.parametrize(("before", "after"), [("cbda", "abcd"), ("adbc", "adbc"), ("fca b".replace(" ", ""), "fabc")])
def test_frames_wait_for_their_bases(before: str, after: str) -> None:
    assert _of_nodes(before) == after
    assert _of_elements(before) == f"{after}-"


def test_frames_in_a_circle_stand_at_the_end_which_only_a_tree_knows() -> None:
    assert _of_elements("ea") == "a-e"
    with pytest.raises(NeedsTree):
        _of_nodes("ea")


def test_parts_of_other_nodes_stay_where_they_are() -> None:
    parts: list[Item] = [(_PARTS[name][0], _write) for name in "ba"]
    assert parts_with_bases_first(Link(name="l"), parts) == parts


def test_untyped_elements_may_be_bases() -> None:
    inner = Model(name="n", opaque=(Opaque(element=Element(name="link")),))
    assert has_untyped_names(Model(name="m", models=(inner,)))
    assert not has_untyped_names(Model(name="m", opaque=(Opaque(element=Element(name="plugin")), Opaque(text="a"))))
