"""Shapes of two robots are paired by what they are, however many a link has."""

from collections.abc import Sequence

import pytest

from twinform.compiler.compare import diff

_FEW, _MANY = 8, 60


def _robot(boxes: Sequence[tuple[str, float]]) -> bytes:
    shapes = "".join(
        f'<visual name="{name}"><geometry><box size="1 1 {size!r}"/></geometry></visual>' for name, size in boxes
    )
    return f'<robot name="r"><link name="a">{shapes}</link></robot>'.encode()


def _messages(a: Sequence[tuple[str, float]], b: Sequence[tuple[str, float]]) -> list[str]:
    found = diff(_robot(a), _robot(b))
    return [each.message for each in found.differences]


@pytest.mark.parametrize("count", [_FEW, _MANY])
def test_equal_shapes_in_another_order_are_the_same(count: int) -> None:
    boxes = [(f"v{n}", n + 1.0) for n in range(count)]
    assert _messages(boxes, boxes[::-1]) == []


@pytest.mark.parametrize("count", [_FEW, _MANY])
def test_a_shape_that_differs_by_rounding_is_the_same(count: int) -> None:
    boxes = [(f"v{n}", n + 1.0) for n in range(count)]
    rounded = [(name, size * (1 + 1e-14)) for name, size in boxes]
    assert _messages(boxes, rounded[::-1]) == []


@pytest.mark.parametrize("count", [_FEW, _MANY])
def test_of_many_shapes_the_one_that_differs_is_named(count: int) -> None:
    boxes = [(f"v{n}", n + 1.0) for n in range(count)]
    other = [*boxes[:3], ("v3", 500.0), *boxes[4:]]
    assert [message.split(" of ")[0] for message in _messages(boxes, other[::-1])] == ["visual 'v3'/geometry/box/size"]


@pytest.mark.parametrize("count", [_FEW, _MANY])
def test_shapes_of_another_color_are_found_by_their_places(count: int) -> None:
    visual = (
        "<visual name='{0}{1}'><pose>{1} 0 0 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry>"
        "<material><diffuse>{2} 0 0 1</diffuse></material></visual>"
    )
    a = "".join(visual.format("v", n, 0.5) for n in range(count))
    b = "".join(visual.format("w", n, 0.6) for n in reversed(range(count)))
    model = "<sdf version='1.9'><model name='m'><link name='l'>{}</link></model></sdf>"
    found = diff(model.format(a).encode(), model.format(b).encode())
    assert {each.aspect.partition("/")[2] for each in found.differences} == {"material/diffuse"}
