"""Text to value and back, for each value type of the formats."""

import math

import pytest

from twinform.schemas import format_value, parse_value
from twinform.schemas.value_types import VALUE_TYPES, format_number, format_numbers, parse_bool

EXPECTED = {
    "urdf": {
        "string": "text",
        "bool": "true or false",
        "int": "a whole number",
        "uint": "a whole number that is not negative",
        "double": "a finite number",
        "vector3": "three numbers",
        "quaternion": "four numbers: x y z w",
        "color4": "four numbers from 0 to 1: red green blue alpha",
    },
    "sdf": {
        "string": "text",
        "bool": "true or false",
        "int": "a whole number",
        "uint": "a whole number that is not negative",
        "double": "a number",
        "vector3": "three numbers",
        "vector2d": "two numbers",
        "vector2i": "two whole numbers",
        "quaternion": "three or four numbers",
        "color": "three or four numbers from 0 to 1: red green blue and perhaps alpha",
        "color4": "four numbers from 0 to 1: red green blue alpha",
        "pose": "six numbers, x y z roll pitch yaw, or seven with a quaternion: x y z qx qy qz qw",
        "time": "seconds, or seconds and nanoseconds",
    },
    "mjcf": {
        "string": "text",
        "words": "words",
        "bool": "true or false",
        "int": "a whole number",
        "double": "a number",
        "vector3": "three numbers",
        "quaternion": "four numbers: w x y z",
        "color4": "four numbers: red green blue alpha",
        "doubles": "numbers",
        "ints": "whole numbers",
        "memory": "a number of bytes, perhaps with K, M, G, T, P or E behind it, or -1",
        "axes": "three letters of x, y, z, X, Y, Z",
        "double.2": "two numbers",
        "double.4": "four numbers",
        "double.6": "six numbers",
        "double.7": "seven numbers",
        "double.1-2": "one to two numbers",
        "double.1-3": "one to three numbers",
        "double.1-5": "one to five numbers",
        "double.1-6": "one to six numbers",
        "double.1-10": "one to ten numbers",
        "int.2": "two whole numbers",
        "int.3": "three whole numbers",
        "int.1-31": "one to 31 whole numbers",
    },
}


def test_every_type_has_what_it_expects() -> None:
    expected = {format: {name: each.expected for name, each in types.items()} for format, types in VALUE_TYPES.items()}
    assert expected == EXPECTED


ARABIC_ONE = "\N{ARABIC-INDIC DIGIT ONE}"
WIDE_BLANK = "\N{EM SPACE}"

GOOD: list[tuple[str, str, str, object]] = [
    ("urdf", "double", " -1.5e2\n", -150.0),
    ("sdf", "double", "+.5", 0.5),
    ("sdf", "double", " -INF ", -math.inf),
    ("sdf", "double", "+inf", math.inf),
    ("urdf", "string", " a ", " a "),
    ("urdf", "bool", " TRUE ", True),
    ("sdf", "bool", "1", True),
    ("sdf", "bool", "False", False),
    ("sdf", "bool", "0", False),
    ("sdf", "int", " -12 ", -12),
    ("sdf", "int", "+0x1F", 31),
    ("sdf", "int", "-0XfF", -255),
    ("sdf", "int", "007", 7),
    ("sdf", "int", "640.0", 640),
    ("sdf", "int", "-7.", -7),
    ("sdf", "uint", "0", 0),
    ("sdf", "uint", "-0.0", 0),
    ("sdf", "uint", "640.0", 640),
    ("sdf", "uint", "3", 3),
    ("sdf", "vector2i", " 1 \n -0x2 ", (1, -2)),
    ("sdf", "vector2i", "2.0 3", (2, 3)),
    ("sdf", "vector2d", "1 2", (1.0, 2.0)),
    ("urdf", "vector3", " 1\t2\n3 ", (1.0, 2.0, 3.0)),
    ("urdf", "vector3", "1e308 1e308 1e308", (1e308, 1e308, 1e308)),
    ("urdf", "quaternion", "0 0 0 1", (0.0, 0.0, 0.0, 1.0)),
    ("sdf", "quaternion", "0 0 1", (0.0, 0.0, 1.0)),
    ("sdf", "quaternion", "0 0 0 1", (0.0, 0.0, 0.0, 1.0)),
    ("urdf", "color4", "1 0 0 1", (1.0, 0.0, 0.0, 1.0)),
    ("sdf", "color4", "1 0 0 1", (1.0, 0.0, 0.0, 1.0)),
    ("sdf", "color", "1 0 0", (1.0, 0.0, 0.0)),
    ("sdf", "color", "1 0 0 1", (1.0, 0.0, 0.0, 1.0)),
    ("mjcf", "bool", "true", True),
    ("mjcf", "bool", "false", False),
    ("mjcf", "int", " -1 ", -1),
    ("mjcf", "double", "inf", math.inf),
    ("mjcf", "double.2", "-inf\t.5", (-math.inf, 0.5)),
    ("mjcf", "double.1-3", "1", (1.0,)),
    ("mjcf", "double.1-3", "1 2 3", (1.0, 2.0, 3.0)),
    ("mjcf", "doubles", " ", ()),
    ("mjcf", "ints", "1 2 3 4", (1, 2, 3, 4)),
    ("mjcf", "words", " a \n\u00a0b ", ("a", "\u00a0b")),
    ("mjcf", "memory", "10M", "10M"),
    ("mjcf", "memory", "-1", "-1"),
    ("mjcf", "axes", "XyZ", "XyZ"),
    ("sdf", "pose", "1 2 3 4 5 6", (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)),
    ("sdf", "pose", "1 2 3 0 0 0 1", (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0)),
    ("sdf", "time", "1.5", 1.5),
    ("sdf", "time", "1 2", (1.0, 2.0)),
]


@pytest.mark.parametrize(("format", "type", "text", "value"), GOOD)
def test_what_fits_is_the_value(format: str, type: str, text: str, value: object) -> None:
    parsed = parse_value(type, text, format)
    assert (parsed, parsed.__class__) == (value, value.__class__)


def test_only_sdf_knows_what_is_no_number() -> None:
    for text in ("nan", " NaN ", "-nan"):
        value = parse_value("double", text)
        assert isinstance(value, float)
        assert math.isnan(value)


BAD = {
    "urdf double": ["", " ", "inf", "nan", "1e400", "1_0", ARABIC_ONE, "0x1", "1,5", "1 2"],
    "sdf double": ["", "1e400", "-1e400", "infinity", "1_0", ARABIC_ONE, f"{WIDE_BLANK}inf", "x"],
    "urdf bool": ["", "yes", "2", f"{WIDE_BLANK}1", "tru"],
    "sdf int": ["", "1.5", "1.0.0", ".0", "0x1.0", "1e3", "0x", "x", "1_0", ARABIC_ONE, f"{WIDE_BLANK}1", "- 1", "0xg"],
    "sdf uint": ["-1", "1.5", "-1.0", "-0x1"],
    "sdf vector2i": ["1", "1 2 3", "1 2.5", f"1{WIDE_BLANK}2"],
    "sdf vector2d": ["1", "1 2 3"],
    "urdf vector3": ["", "1 2", "1 2 3 4", "1 2 x", "1 2 inf", "nan 1 2", "1 2 1_0", f"1{WIDE_BLANK}2 3"],
    "urdf quaternion": ["0 0 1"],
    "urdf color4": ["1 0 0"],
    "sdf quaternion": ["0 1", "0 0 0 0 1"],
    "sdf color": ["1 0", "1 0 0 1 1"],
    "sdf pose": ["1 2 3 4 5", "1 2 3 4 5 6 7 8"],
    "sdf time": ["", "x", "1 2 3", "1 x", "inf", "1_0"],
    "mjcf bool": ["", "1", "0", "True", " true "],
    "mjcf int": ["", "1.0", "0x1", "1e3", "2147483648", ARABIC_ONE, "1 2"],
    "mjcf double": ["", "1e400", "1_0", "1,5", "1 2"],
    "mjcf double.2": ["1", "1 2 3", "1 x"],
    "mjcf double.1-3": ["", "1 2 3 4"],
    "mjcf doubles": ["x", "1 1e400"],
    "mjcf ints": ["1 1.5"],
    "mjcf memory": ["", "1.5K", "1KB", "-2"],
    "mjcf axes": ["xy", "xyzx", "xyw", " xyz"],
}


@pytest.mark.parametrize(("words", "text"), [(words, text) for words, texts in BAD.items() for text in texts])
def test_what_does_not_fit_is_refused(words: str, text: str) -> None:
    format, type = words.split()
    with pytest.raises(ValueError):  # noqa: PT011 - the parsers leave the message to those who call them
        parse_value(type, text, format)


def test_a_bool_is_one_of_four_texts() -> None:
    assert [parse_bool(word) for word in ("true", "1", "TRUE", "false", "0")] == [True, True, True, False, False]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (True, "true"),
        (False, "false"),
        (1, "1"),
        (1.0, "1"),
        (-0.0, "-0"),
        (0.1, "0.1"),
        (1e22, "1e+22"),
        ("a b", "a b"),
        ((1.0, 2.5), "1 2.5"),
        ((1, 2), "1 2"),
        ((), ""),
    ],
)
def test_a_value_is_written_as_short_as_it_can_be(value: object, text: str) -> None:
    assert format_value(value) == text


def test_numbers_are_written_alike_alone_and_together() -> None:
    numbers = (1.0, -0.5, 100.05, 1e-7)
    assert [format_number(number) for number in numbers] == ["1", "-0.5", "100.05", "1e-07"]
    assert format_numbers(numbers) == format_value(numbers) == "1 -0.5 100.05 1e-07"
    assert format_numbers(()) == ""
