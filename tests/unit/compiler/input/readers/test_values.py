"""Parsers of usual values agree with those of the value types, or return None."""

from collections.abc import Callable

import pytest
from lxml import etree

from twinform.compiler.input.readers import values
from twinform.schemas import VALUE_TYPES

TEXTS = (
    "", " ", "1", " 1 ", "-0", "-0.0", "1e3", "1_0", "\u0661", "inf", "-inf", "nan", "1e400", "0x1F", "1.5", "yes",
    "true", "0 0 0", "1 2", "1 2 3", " 1\t2\n3 ", "1 2 x", "1 2 inf", "1e308 1e308 1e308", "0 0 \u0661", "1 2 3 4",
    "0 0 0 0 0 0", "1 2 3 4 5 6", "0 0 0 0 0 0 1", "1 2 3 4 5 nan",
)  # fmt: skip
PARSERS: list[tuple[Callable[[str | None], object], str, str, str]] = [
    (values.double, "urdf", "double", "1e3"),
    (values.loose_double, "sdf", "double", "inf"),
    (values.vector3, "urdf", "vector3", " 1\t2\n3 "),
    (values.integer, "sdf", "int", "0x1F"),
    (values.natural, "sdf", "uint", "1"),
    (values.vector2d, "sdf", "vector2d", "1 2"),
    (values.color, "sdf", "color", "1 2 3"),
    (values.color4, "urdf", "color4", "1 2 3 4"),
    (values.quaternion, "urdf", "quaternion", "1 2 3 4"),
]


def parsed(format_: str, type_: str, text: str) -> object:
    try:
        return VALUE_TYPES[format_][type_].parse(text)
    except ValueError:
        return None


@pytest.mark.parametrize(("parse", "format_", "type_", "usual"), PARSERS)
def test_a_usual_value_is_that_of_its_type(
    parse: Callable[[str | None], object], format_: str, type_: str, usual: str
) -> None:
    for text in TEXTS:
        value = parse(text)
        assert value is None or repr(value) == repr(parsed(format_, type_, text)), text
    assert parse(usual) is not None
    assert parse(None) is None


def test_a_usual_pose_is_a_translation_and_a_rotation() -> None:
    assert values.pose("1 2 3 4 5 6") == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    assert values.pose(None) is None
    for text in TEXTS:
        value = values.pose(text)
        assert value is None or (*value[0], *value[1]) == parsed("sdf", "pose", text)


@pytest.mark.parametrize(
    ("text", "expected"), [("<a> b </a>", " b "), ("<a/>", None), ("<a x='1'>b</a>", None), ("<a>b<c/></a>", None)]
)
def test_text_alone_is_text_beside_which_there_is_nothing(text: str, expected: str | None) -> None:
    assert values.only_text(etree.fromstring(text)) == expected


def test_stripped_text_has_no_white_space_around_it() -> None:
    assert [values.stripped(text) for text in (None, "", " \n", " a b\t", "\u00a0a")] == [
        None,
        None,
        None,
        "a b",
        "\u00a0a",
    ]
