"""How much a file may be, with limits that a test can reach."""

import io
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import twinform
from twinform.compiler.input import size_limits
from twinform.compiler.input.size_limits import (
    LIFTED_BY_SIZE,
    LIFTED_BY_TAGS,
    Excess,
    Limits,
    excess_of_bytes,
    excess_of_json,
    excess_of_tree,
    parse_size,
    uncountable_encoding,
)
from twinform.diagnostics import Location
from twinform.file_access import read_up_to


@pytest.mark.parametrize("measure", [excess_of_bytes, excess_of_json])
def test_a_file_has_a_largest_size(measure: Callable[[bytes, Limits], Excess | None]) -> None:
    few = Limits(size=1000)
    assert measure(b"x" * 1000, few) is None
    assert measure(b"x" * 1001, few) == Excess("the file has more than 1,000 bytes", help=LIFTED_BY_SIZE)
    assert measure(b"x" * 1001, Limits(size=1001)) is None


def test_a_file_has_a_largest_number_of_parts() -> None:
    few, more = Limits(tags=2), Limits(tags=3)
    assert excess_of_bytes(b"<a></a>", few) is None
    assert excess_of_bytes(b"<a><b/></a>", few) == Excess("the file has 3 tags; the limit is 2", help=LIFTED_BY_TAGS)
    assert excess_of_bytes(b"<a><b/></a>", more) is None
    assert excess_of_json(b'{"a": []}', few) is None
    excess = Excess("the document has 3 parts; the limit is 2", help=LIFTED_BY_TAGS)
    assert excess_of_json(b'{"a": [{}]}', few) == excess
    assert excess_of_json(b'{"a": [{}]}', more) is None


def test_the_usual_limits_are_those_that_the_options_name() -> None:
    assert Limits() == Limits(64 * 2**20, 1_000_000) == Limits(parse_size("64MiB"))


@pytest.mark.parametrize(
    ("text", "size"),
    [
        ("1", 1),
        ("67108864", 2**26),
        ("64MB", 64_000_000),
        ("64 MiB", 2**26),
        ("1.5GiB", 3 * 2**29),
        ("2g", 2 * 10**9),
        ("10kb", 10_000),
        (" 10 KiB ", 10_240),
        ("7b", 7),
    ],
)
def test_sizes_have_units(text: str, size: int) -> None:
    assert parse_size(text) == size


@pytest.mark.parametrize(
    "text", ["", "MB", "-1", "0", "0.1", "0MB", "1e9", "nan", "inf", "1 TB", "64MBB", "1,000", "٣", "1" * 400, "2 0"]
)
def test_what_is_no_size_is_an_error(text: str) -> None:
    with pytest.raises(ValueError, match="is no size; write a number of bytes"):
        parse_size(text)


@pytest.mark.parametrize("value", [0, -1, True, 1.5, "64MB"])
def test_limits_are_positive_whole_numbers(value: Any) -> None:
    with pytest.raises(ValueError, match="max_size has to be a positive whole number"):
        twinform.check(b"<robot/>", max_size=value)
    with pytest.raises(ValueError, match="max_tags has to be a positive whole number"):
        twinform.convert(b"<robot/>", to="sdf", max_tags=value)


@pytest.mark.parametrize(("size", "expected"), [(3, b"abcd"), (5, b"abcdef"), (6, b"abcdef"), (2**70, b"abcdef")])
def test_of_a_file_no_more_is_read_than_tells_that_it_is_too_large(size: int, expected: bytes) -> None:
    assert read_up_to(io.BytesIO(b"abcdef"), size) == expected


_ROBOT = '<robot name="r"><link name="a"/></robot>'


@pytest.mark.parametrize(
    ("most", "less", "name"),
    [
        (Limits(size=len(_ROBOT)), Limits(size=len(_ROBOT) - 1), "max_size"),
        (Limits(tags=3), Limits(tags=2), "max_tags"),
    ],
)
def test_every_way_of_reading_takes_the_limits(tmp_path: Path, most: Limits, less: Limits, name: str) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(_ROBOT)
    for source in (path, _ROBOT.encode()):
        assert twinform.check(source, max_size=most.size, max_tags=most.tags).accepted
        (found,) = twinform.check(source, max_size=less.size, max_tags=less.tags).diagnostics
        assert f"in Python {name}" in (found.help or "")
    ways: list[Callable[..., object]] = [
        partial(twinform.load, path),
        partial(twinform.loads, _ROBOT),
        partial(twinform.convert, path, to="sdf"),
        partial(twinform.diff, path, path),
    ]
    for way in ways:
        way(max_size=most.size, max_tags=most.tags)
        with pytest.raises(twinform.CompileError):
            way(max_size=less.size, max_tags=less.tags)


def test_json_documents_have_the_same_limits() -> None:
    text = twinform.convert(_ROBOT.encode(), to="json").text.encode()
    parts = text.count(b"{") + text.count(b"[")
    assert twinform.check(text, max_size=len(text), max_tags=parts).accepted
    (found,) = twinform.check(text, max_size=len(text) - 1).diagnostics
    assert (found.rule.name, found.help) == ("oversized-file", LIFTED_BY_SIZE)
    (found,) = twinform.check(text, max_tags=parts - 1).diagnostics
    assert (found.rule.name, found.help) == ("oversized-file", LIFTED_BY_TAGS)


def test_includes_have_the_same_limits(tmp_path: Path) -> None:
    links = "".join(f'<link name="{name}"/>' for name in "abcd")
    part = f'<sdf version="1.11"><model name="part">{links}</model></sdf>'  # six elements and as many attributes
    around = "<include><name>p{}</name><uri>part.sdf</uri></include>"
    (tmp_path / "part.sdf").write_text(part)
    path = tmp_path / "world.sdf"
    path.write_text(f'<sdf version="1.11"><world name="w">{"".join(map(around.format, range(9)))}</world></sdf>')
    assert twinform.check(path, expand_includes=True, max_tags=9 * 12).accepted
    (found,) = (
        each for each in twinform.check(path, expand_includes=True, max_tags=9 * 12 - 1).diagnostics if each.is_error
    )
    assert (found.rule.name, found.help) == ("too-many-includes", LIFTED_BY_TAGS)
    assert "these are more than 107 elements and attributes" in found.message
    (tmp_path / "part.sdf").write_text(part + " " * path.stat().st_size)
    assert twinform.check(path, expand_includes=True).accepted
    (found,) = twinform.check(path, expand_includes=True, max_size=path.stat().st_size).diagnostics
    assert (found.rule.name, found.help) == ("unreadable-file", LIFTED_BY_SIZE)


def test_an_element_has_so_many_attributes_and_a_name_so_many_characters() -> None:
    crowded = "".join(f" a{number}='{'x' * 10}'" for number in range(size_limits.MOST_ATTRIBUTES + 1))
    text = f"<robot name='r'>\n<link name='l'><visual{crowded}/></link></robot>".encode()
    path = "/robot[@name='r']/link[@name='l']/visual"
    words = f"<visual> has {size_limits.MOST_ATTRIBUTES + 1:,} attributes; the limit is {size_limits.MOST_ATTRIBUTES}"
    assert excess_of_tree(etree.fromstring(text), text) == Excess(words, Location(line=2, path=path))
    text = f"<robot name='{'r' * (size_limits.LONGEST_NAME + 1)}'/>".encode()
    most = size_limits.LONGEST_NAME
    words = f"<robot> has {most + 1:,} characters in its name; the limit is {most:,}"
    assert excess_of_tree(etree.fromstring(text), text) == Excess(words, Location(line=1, path="/robot"))


def _nested(depth: int) -> bytes:
    opened = "".join(f"<model name='m{number}'><link name='l'/>" for number in range(depth))
    return f"<sdf version='1.11'>{opened}{'</model>' * depth}</sdf>".encode()


def test_an_element_has_so_many_elements_in_it() -> None:
    """Each of them is a part of the model; 200,000 in one line took 14 seconds."""
    most = size_limits.MOST_CHILDREN
    inside = "<!-- a --><x/>" * most
    for more, message in (
        ("", None),
        (
            "<x/>",
            f"<link> has {size_limits.MOST_CHILDREN + 1:,} elements in it; the limit is {size_limits.MOST_CHILDREN:,}",
        ),
    ):
        text = f"<robot name='r'>\n<link name='l'>{inside}{more}</link></robot>".encode()
        excess = excess_of_tree(etree.fromstring(text), text)
        assert (excess and excess.message) == message
        assert excess is None or excess.location == Location(line=2, path="/robot[@name='r']/link[@name='l']")
        assert excess_of_tree(etree.fromstring(text), text, Limits(tags=size_limits.MOST_TAGS + 1)) is None


def test_a_file_has_so_many_texts_between_its_elements() -> None:
    """Each of them is carried; 80,000 in 400 kB took `diff` ten seconds."""
    inside = "a<x>b</x>" * size_limits.MOST_STRAY_TEXTS
    for more, message in (("", None), ("a", "the file has 10,001 texts between its elements; the limit is 10,000")):
        text = f"<robot name='r'><link name='l'>{inside}</link>{more}</robot>".encode()
        excess = excess_of_tree(etree.fromstring(text), text)
        assert (excess and excess.message) == message
        assert excess_of_tree(etree.fromstring(text), text, Limits(tags=size_limits.MOST_TAGS + 1)) is None


def test_so_many_names_with_two_colons_are_repaired() -> None:
    """Each is repaired again in each round of fixes."""
    checked = twinform.check(f"<robot name='r'>{'<x::y/>' * (size_limits.MOST_COLONS + 1)}</robot>".encode())
    message = "10,001 names of the file have two colons behind their prefix; the limit is 10,000"
    assert [(each.rule.name, each.message) for each in checked.diagnostics] == [("oversized-file", message)]


def test_models_are_so_deep_in_each_other() -> None:
    document = twinform.loads(_nested(size_limits.DEEPEST_MODELS))
    assert twinform.convert(document, to="urdf").text
    assert twinform.diff(document, document).same
    for source in (_nested(size_limits.DEEPEST_MODELS + 1), _nested(250)):
        found = [(each.rule.name, each.message) for each in twinform.check(source).diagnostics]
        assert found == [("oversized-file", "models are in each other more than 64 deep")]


def test_what_is_long_and_no_name_is_no_excess() -> None:
    text = f"<robot name='r' other='{'r' * (size_limits.LONGEST_NAME + 1)}'/>".encode()
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
