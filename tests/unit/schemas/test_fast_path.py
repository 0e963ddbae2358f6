"""The short way through an element gives up on all that needs a word, and has then done nothing."""

import math
from typing import Any

import pytest

from twinform.schemas import Fact
from twinform.schemas.fast_path import GIVE_UP, quick_parse
from twinform.schemas.values import VALUE_TYPES

TYPES = VALUE_TYPES["sdf"]
NOW = (1, 5)

UNUSUAL: dict[str, Fact] = {
    "no place": Fact("a", type="double"),
    "a node further in": Fact("a", type="double", place="outer.field"),
    "the header": Fact("a", type="double", place="/field"),
    "no type": Fact("a", place="field"),
    "a tuple": Fact("a", "*", type="double", place="field"),
    "a tuple of one": Fact("a", "?", type="double", place="field", many=True),
    "a later version": Fact("a", type="double", place="field", since=(1, 6)),
    "an earlier version": Fact("a", type="double", place="field", until=(1, 4)),
    "a dialect": Fact("a", type="double", place="field", dialect="drake"),
}


@pytest.mark.parametrize("name", UNUSUAL)
def test_there_is_no_short_way_for_an_unusual_row(name: str) -> None:
    assert quick_parse(UNUSUAL[name], TYPES, NOW) is None


PARSED: list[tuple[dict[str, Any], dict[str, object], list[str]]] = [
    ({"type": "double"}, {"1": 1.0, " -2e3 ": -2000.0, "inf": math.inf}, ["", "a", "1_0", "1e999"]),
    ({"type": "string"}, {"": "", " a ": " a "}, []),
    ({"type": "bool"}, {"true": True, "false": False}, ["1", "0", "True", " true", ""]),
    ({"type": "string", "enum": ("a", "b")}, {"a": "a", "b": "b"}, ["c", " a", "", "A"]),
    ({"type": "double", "min": 0.0}, {"0": 0.0, "inf": math.inf}, ["-0.1", "nan"]),
    ({"type": "int", "max": 2.0}, {"2": 2, "-9": -9}, ["3"]),
    ({"type": "double", "min": 0.0, "max": 1.0}, {"0": 0.0, "0.5": 0.5, "1": 1.0}, ["-0.1", "1.1"]),
    (
        {"type": "vector3", "min": 0.0, "max": 1.0},
        {"0 1 0.5": (0.0, 1.0, 0.5)},
        ["-0.1 0 0", "0 0 -0.1", "0 1.1 0", "0 0", "0 0 0 0"],
    ),
    ({"type": "vector2d", "max": 1.0}, {"-5 1": (-5.0, 1.0)}, ["0 2"]),
    ({"type": "color", "min": 0.0}, {"0 1 2": (0.0, 1.0, 2.0)}, ["0 -1 0"]),
    ({"type": "vector3"}, {"-1 2 3": (-1.0, 2.0, 3.0)}, ["1 2", "1 2 nan"]),
]


@pytest.mark.parametrize(("row", "values", "bad"), PARSED)
def test_usual_values_are_parsed(row: dict[str, Any], values: dict[str, object], bad: list[str]) -> None:
    parse = quick_parse(Fact("@a", place="field", **row), TYPES, NOW)
    assert parse
    assert {text: parse(text) for text in values} == values
    for text in bad:
        with pytest.raises(GIVE_UP):
            parse(text)


def test_bounds_of_urdf_colors_are_those_of_vectors() -> None:
    parse = quick_parse(Fact("@rgba", type="color4", min=0, max=1, place="rgba"), VALUE_TYPES["urdf"], (1, 0))
    assert parse
    assert parse("0 1 0 1") == (0.0, 1.0, 0.0, 1.0)
    with pytest.raises(GIVE_UP):
        parse("0 2 0 1")
