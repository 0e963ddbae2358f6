"""Joint positions as text, and the ends of sliders."""

import json
import math

import pytest

pytest.importorskip("viser", reason="viser is not installed")

from hypothesis import given
from hypothesis import strategies as st

from twinform.compiler.kinematics import Degree
from twinform.view.joint_controls import positions_of, slider_range


@pytest.mark.parametrize(
    ("text", "positions"),
    [
        ('{"a": 1, "b": [0.5, -2]}', {("a", 0): 1.0, ("b", 0): 0.5, ("b", 1): -2.0}),
        ('{"a": "1", "b": null, "c": {}, "d": 1e999}', {}),
        ("", {}),
        ("[1]", {}),
        ("1" * 10_000, {}),
        ("[" * 100_000, {}),
        ('{"a": NaN}', {}),
        ('{"a": 1' + "0" * 400 + "}", {}),
    ],
    ids=["numbers", "no numbers", "empty", "list", "digits", "nested", "nan", "large"],
)
def test_positions_are_read_from_text(text: str, positions: dict[tuple[str, int], float]):
    assert positions_of(text) == positions


@given(st.text())
def test_no_text_is_an_error(text: str):
    for value in (text, json.dumps({text: 1.0})):
        assert all(math.isfinite(each) for each in positions_of(value).values())


@given(st.floats(-10, 10), st.floats(-10, 10), st.booleans())
def test_beyond_the_limits_is_more_than_within(lower: float, upper: float, slides: bool):
    degree = Degree((0, 0, 1), slides=slides, lower=lower, upper=upper)
    within, beyond = slider_range(degree), slider_range(degree, beyond=True)
    assert beyond[0] < within[0] <= within[1] < beyond[1]
    assert (within[0] == within[1]) == (lower == upper)
