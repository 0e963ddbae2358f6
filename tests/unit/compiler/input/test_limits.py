"""How much a file may be, with limits that a test can reach."""

from collections.abc import Callable

import pytest
from lxml import etree

import twinform
from twinform.compiler.input import limits
from twinform.compiler.input.limits import Excess, excess_of_bytes, excess_of_json, excess_of_tree, uncountable_encoding
from twinform.diagnostics import Location


@pytest.mark.parametrize("measure", [excess_of_bytes, excess_of_json])
def test_a_file_has_a_largest_size(measure: Callable[[bytes], Excess | None], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "LARGEST", 1000)
    assert measure(b"x" * 1000) is None
    assert measure(b"x" * 1001) == Excess("the file has more than 1,000 bytes")


def test_a_file_has_a_largest_number_of_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MOST_TAGS", 2)
    assert excess_of_bytes(b"<a></a>") is None
    assert excess_of_bytes(b"<a><b/></a>") == Excess("the file has 3 tags; the limit is 2")
    assert excess_of_json(b'{"a": []}') is None
    assert excess_of_json(b'{"a": [{}]}') == Excess("the document has 3 parts; the limit is 2")


def test_an_element_has_so_many_attributes_and_a_name_so_many_characters() -> None:
    crowded = "".join(f" a{number}='{'x' * 10}'" for number in range(limits.MOST_ATTRIBUTES + 1))
    text = f"<robot name='r'>\n<link name='l'><visual{crowded}/></link></robot>".encode()
    path = "/robot[@name='r']/link[@name='l']/visual"
    words = f"<visual> has {limits.MOST_ATTRIBUTES + 1:,} attributes; the limit is {limits.MOST_ATTRIBUTES}"
    assert excess_of_tree(etree.fromstring(text), text) == Excess(words, Location(line=2, path=path))
    text = f"<robot name='{'r' * (limits.LONGEST_NAME + 1)}'/>".encode()
    words = f"<robot> has {limits.LONGEST_NAME + 1:,} characters in its name; the limit is {limits.LONGEST_NAME:,}"
    assert excess_of_tree(etree.fromstring(text), text) == Excess(words, Location(line=1, path="/robot"))


def _nested(depth: int) -> bytes:
    opened = "".join(f"<model name='m{number}'><link name='l'/>" for number in range(depth))
    return f"<sdf version='1.11'>{opened}{'</model>' * depth}</sdf>".encode()


def test_models_are_so_deep_in_each_other() -> None:
    document = twinform.loads(_nested(limits.DEEPEST_MODELS))
    assert twinform.convert(document, to="urdf").text
    assert twinform.diff(document, document).same
    for source in (_nested(limits.DEEPEST_MODELS + 1), _nested(250)):
        found = [(each.rule.name, each.message) for each in twinform.check(source).diagnostics]
        assert found == [("oversized-file", "models are in each other more than 64 deep")]


def test_what_is_long_and_no_name_is_no_excess() -> None:
    text = f"<robot name='r' other='{'r' * (limits.LONGEST_NAME + 1)}'/>".encode()
    assert excess_of_tree(etree.fromstring(text), text) is None


@pytest.mark.parametrize(
    ("declaration", "expected"),
    [
        (b"<?xml version='1.0' encoding='utf-8'?>", None),
        (b"<?xml version='1.0' encoding='ISO-8859-15'?>", None),
        (b"<?xml version='1.0'?>", None),
        (b"<?xml version='1.0' encoding='UTF-7'?>", "UTF-7"),
        (b"<?xml version='1.0' encoding='cp037'?>", "cp037"),
    ],
)
def test_tags_are_counted_in_encodings_that_show_them(declaration: bytes, expected: str | None) -> None:
    assert uncountable_encoding(declaration + b"<robot/>") == expected
