"""Tags that are looked for stand where expat says that they do."""

from pathlib import Path

import pytest

from twinform.text import SourceText, UnplacedError, spans
from twinform.text.positions import Tags

_CASES = Path(__file__).parents[2] / "cases"
_FILES = sorted([*_CASES.glob("check/*.*df"), *_CASES.glob("whole/*.*df"), *_CASES.glob("elements/*.*df")])

TEXTS = {
    "a bracket in a value": "<a b='>' c=\"/>\"><d e='<!--'/>>]]</a>".replace("<!--", "&lt;!--"),
    "quotes in the other quotes": """<a b='"' c="'"><d/></a>""",
    "a section": "<a><![CDATA[<b></c>]]><d/></a>",
    "comments and instructions": "<?xml version='1.0'?><!-- <z/> --><a><!-- <b> --><?p <c> ?><d/><!----></a><!-- e -->",
    "blanks": "<a\n\tb = '1'\r\n><c /></a >",
    "deep": "<a>" * 200 + "</a>" * 200,
    "prefixes": "<x:a xmlns:x='u' x:b='1'><x:c/></x:a>",
    "letters of all kinds": "<ä ö='\U0001f600'><日本/></ä>",
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_all_is_where_expat_finds_it(text: str) -> None:
    tags, root = Tags(text), spans(text)
    assert tags.element(0) == root
    assert [tags.element(place) for place in range(len(tags))] == list(root.walk())
    assert [*tags.names] == [each.name.of(text) for each in root.walk()]


@pytest.mark.parametrize("path", _FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_the_cases_are_read_as_expat_reads_them(path: Path) -> None:
    text = SourceText.of(path.read_bytes()).text
    try:
        root = spans(text)
    except UnplacedError:
        return
    tags = Tags(text)
    assert tags.element(0) == root
    assert tags.starts == [each.start_tag.start for each in root.walk()]


def test_what_parsers_repair_is_no_hindrance() -> None:
    text = "\n ?xml version='1.0'?>\n<a><!-- b -- c --><d:e/><?xml version='1.0'?><f::g/></a>"
    assert Tags(text).names == ["a", "d:e", "f::g"]


def test_of_an_element_that_holds_very_much_the_start_tag_is_known() -> None:
    text = f"<a><b c='1'>{'<d/>' * 5000}</b></a>"
    known = Tags(text).element(1)
    assert (known.start_tag, list(known.attributes), known.children) == ((3, 12), ["c"], [])
    assert Tags(text).element(0).start_tag == spans(text).start_tag


@pytest.mark.parametrize("text", ["<a>", "<a><b>", "<a><b></b>"])
def test_an_element_without_an_end_has_no_place(text: str) -> None:
    with pytest.raises(UnplacedError):
        Tags(text).element(0)
