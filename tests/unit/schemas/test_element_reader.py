"""A value that is plain is what the reader of its row stores, and that reader has nothing to say about it."""

from typing import Any

import pytest
from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.schemas import Context, Fact
from twinform.schemas.element_reader import plain_values, store_plain
from twinform.schemas.value_readers import attribute_reader, text_reader
from twinform.schemas.value_types import VALUE_TYPES

NOW = (1, 5)
TEXTS = (
    "", " ", "1", " 1 ", "0", "-0", "-0.0", "1e3", "1_0", "\u0661", "inf", "-inf", "nan", "1e400", "0x1F", "1.5", "yes",
    "true", "false", "True", "a", "c", " a", "0 0 0", "0 -1 0", "1 2", "1 2 3", " 1\t2\n3 ", "1 2 x", "1 2 inf",
    "1e308 1e308 1e308", "0 0 \u0661", "1 2 3 4", "0 2 0 1", "0 0 0 0 0 0", "1 2 3 4 5 6", "-0.1", "1.1", "-9", "9",
)  # fmt: skip
ROWS: list[tuple[str, dict[str, Any], str]] = [
    *((format_, {"type": name}, usual) for format_, name, usual in (
        ("urdf", "double", "1e3"), ("sdf", "double", "inf"), ("urdf", "vector3", " 1\t2\n3 "), ("sdf", "int", "0x1F"),
        ("sdf", "uint", "1"), ("sdf", "vector2d", "1 2"), ("sdf", "color", "1 2 3"), ("urdf", "color4", "1 2 3 4"),
        ("urdf", "quaternion", "1 2 3 4"), ("sdf", "string", "a"), ("sdf", "bool", "true"),
    )),
    ("sdf", {"type": "string", "enum": ("a", "b")}, "a"),
    ("sdf", {"type": "string", "default": "a"}, "a"),
    ("sdf", {"type": "double", "min": 0.0}, "inf"),
    ("sdf", {"type": "double", "min": 0.0, "max": 1.0}, "1"),
    ("sdf", {"type": "int", "max": 2.0}, "-9"),
    ("sdf", {"type": "vector3", "min": 0.0, "max": 3.0}, "1 2 3"),
    ("urdf", {"type": "color4", "min": 0.0, "max": 3.0}, "0 2 0 1"),
]  # fmt: skip
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
    "a deprecated row": Fact("a", type="double", place="field", deprecated=True),
    "a row that is skipped": Fact("a", type="double", place="field", aside=True),
    "a row with attributes": Fact("a", type="double", place="field", rows=[Fact("@b", type="double")]),
}


@pytest.mark.parametrize("name", UNUSUAL)
def test_no_value_of_an_unusual_row_is_plain(name: str) -> None:
    assert plain_values([UNUSUAL[name]], VALUE_TYPES["sdf"], NOW) == {}


@pytest.mark.parametrize(("format_", "keys", "usual"), ROWS)
@pytest.mark.parametrize("name", ["@a", "a"])
def test_a_plain_value_is_what_its_reader_stores(format_: str, keys: dict[str, Any], usual: str, name: str) -> None:
    row, types = Fact(name, place="field", **keys), VALUE_TYPES[format_]
    plain = plain_values([row], types, NOW)["a"]
    assert store_plain(plain, usual, {})
    for text in TEXTS:
        stored: dict[str, Any] = {}
        if store_plain(plain, text, stored):
            assert repr(stored) == repr(read(row, format_, text)), text
        else:
            assert stored == {}


def read(row: Fact, format_: str, text: str) -> dict[str, Any]:
    """What the reader of a row stores, which has no finding."""
    element, node = etree.Element("a"), dict[str, Any]()
    context = Context(DiagnosticSink(), "", format_, NOW)
    if row.is_attribute:
        attribute_reader(row, VALUE_TYPES[format_], NOW, "", keep=True)(element, "a", text, node, context)
    else:
        element.text = text
        text_reader(row, VALUE_TYPES[format_], keep=True)(element, node, context)
    assert not context.sink.diagnostics
    return node


def test_there_is_no_plain_value_without_a_text() -> None:
    for format_, keys, _ in ROWS:
        plain = plain_values([Fact("a", place="field", **keys)], VALUE_TYPES[format_], NOW)["a"]
        assert not store_plain(plain, None, {})
