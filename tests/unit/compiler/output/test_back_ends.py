"""Frames stand behind what they are attached to, in typed models and in untyped ones."""

import pytest

from twinform.compiler.output.emitting import with_bases_first
from twinform.ir import Element, Frame, Link, Model, Node, Opaque, Pose
from twinform.schemas import Item

_PARTS: dict[str, tuple[Node, Element]] = {
    "c": (
        Frame(name="c", attached_to="b"),
        Element(name="frame", attributes=(("name", "c"), ("attached_to", "b"))),
    ),
    "b": (
        Frame(name="b", attached_to="a::x"),
        Element(name="frame", attributes=(("name", "b"), ("attached_to", "a::x"))),
    ),
    "d": (
        Frame(name="d", pose=Pose(relative_to="a")),
        Element(
            name="frame",
            attributes=(("name", "d"),),
            children=(Element(name="pose", attributes=(("relative_to", "a"),)),),
        ),
    ),
    "a": (Link(name="a"), Element(name="link", attributes=(("name", "a"),))),
    "e": (
        Frame(name="e", attached_to="e"),
        Element(name="frame", attributes=(("name", "e"), ("attached_to", "e"))),
    ),
    "f": (
        Frame(name="f", attached_to="elsewhere"),
        Element(name="frame", attributes=(("name", "f"), ("attached_to", "elsewhere"))),
    ),
}
_MODEL = Model(name="m", frames=tuple(node for node, _ in _PARTS.values() if isinstance(node, Frame)))


def _names(items: list[Item]) -> str:
    return "".join(str(part.get("name") if isinstance(part, Element) else part.name) for part, _ in items)


def _of_nodes(order: str, model: Model = _MODEL) -> str:
    return "-".join(map(_names, with_bases_first(model, [(_PARTS[name][0], None) for name in order])))


def _of_elements(order: str) -> str:
    return "-".join(map(_names, with_bases_first(Element(name="model"), [(_PARTS[name][1], None) for name in order])))


@pytest.mark.parametrize(("before", "after"), [("cbda", "abcd"), ("adbc", "adbc"), ("fcab", "fabc")])
def test_frames_wait_for_their_bases(before: str, after: str) -> None:
    assert _of_nodes(before) == _of_elements(before) == f"{after}-"


def test_frames_in_a_circle_stand_behind_all_else() -> None:
    assert _of_nodes("ea") == _of_elements("ea") == "a-e"


def test_frames_on_an_untyped_element_stand_behind_it() -> None:
    model = _MODEL.copy(opaque=(Opaque(element=_PARTS["a"][1]), Opaque(text="x")))
    assert _of_nodes("cbf", model) == "f-bc"


def test_parts_of_others_stay_where_they_are() -> None:
    parts: list[Item] = [(_PARTS[name][0], None) for name in "ba"]
    for holder in (Link(name="l"), Model(name="m"), Element(name="world")):
        assert with_bases_first(holder, parts) == (parts, [])
