"""The tolerant tree: the same elements as an XML parser finds, and something sensible for everything else."""

from pathlib import Path
from time import perf_counter

import pytest
from hypothesis import given

from testbed.corpus.files import ROOT
from twinform import convert
from twinform.ir import Document
from twinform.server.tolerant_tree import TolerantNode, parse
from twinform.testing.strategies import robots
from twinform.text import ElementSpan, spans

EXAMPLES = sorted(path for path in (ROOT / "examples").iterdir() if path.suffix in {".urdf", ".sdf", ".xacro"})


def same(node: TolerantNode, span: ElementSpan) -> bool:
    attributes = list(node.attributes.items()) == list(span.attributes.items())
    tags = (node.start_tag, node.name, node.end_tag, node.whole) == (
        span.start_tag,
        span.name,
        span.end_tag,
        span.whole,
    )
    return attributes and tags and len(node.children) == len(span.children)


def assert_same(text: str) -> None:
    tree = parse(text)
    assert tree.whole
    assert tree.root is not None
    places = list(spans(text).walk())
    assert len(tree.nodes) == len(places)
    assert all(same(node, place) for node, place in zip(tree.nodes, places, strict=True))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_a_file_that_is_well_formed_has_the_elements_that_expat_finds(path: Path) -> None:
    assert_same(path.read_text(encoding="utf-8"))


@given(robots())
def test_generated_robots_have_the_elements_that_expat_finds(document: Document) -> None:
    assert_same(convert(document, to=document.format.value).text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<a><b><c/></a>", {"a": (0, 14), "b": (3, 10), "c": (6, 10)}),
        ("<a></b></a>", {"a": (0, 11)}),
        ("<a><b x='1' <c/></a>", {"a": (0, 20), "b": (3, 12), "c": (12, 16)}),
        ('<a><b x="1\n<c/></a>', {"a": (0, 19), "b": (3, 11), "c": (11, 15)}),
        ("<a><b", {"a": (0, 5), "b": (3, 5)}),
        ("<a><!-- <b> ", {"a": (0, 12)}),
        ("<a><![CDATA[<b>]]></a>", {"a": (0, 22)}),
        ("text", {}),
    ],
)
def test_what_is_missing_ends_where_it_has_to(text: str, expected: dict[str, tuple[int, int]]) -> None:
    assert {node.tag: tuple(node.whole) for node in parse(text).nodes} == expected


@pytest.mark.parametrize(
    "text",
    ["<a " * 50_000, "<a>" * 50_000 + "</b>" * 50_000, "<a b='" * 50_000, "<!--" * 50_000, "<a" + " x" * 100_000,
     "<a " + 'x="' * 100_000, "</a" * 50_000, "<" * 50_000, "<a x=" + " " * 100_000, "<a>" * 50_000 + "</a>" * 50_000],
    ids=lambda text: text[:6],
)  # fmt: skip
def test_time_is_linear_in_the_text_whatever_is_in_it(text: str) -> None:
    start = perf_counter()
    parse(text[: len(text) // 8])
    short = perf_counter() - start
    start = perf_counter()
    parse(text)
    assert perf_counter() - start < max(0.5, 40 * short)
