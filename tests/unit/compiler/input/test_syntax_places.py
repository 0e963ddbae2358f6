"""The piece of a text that a syntax error is about, and what libxml2 makes of the same text."""

import pytest

import twinform
from twinform.compiler.input.finding_spans import located
from twinform.compiler.input.syntax_places import SyntaxPlaces
from twinform.compiler.input.xml_recovery import XmlError

HEAD = '<robot name="r">\n  '
REFUSED = {
    "another end tag": HEAD + '<link name="a">\n  </«lnk»>\n</robot>',
    "an ampersand": HEAD + '<link name="a «&» b"/>\n</robot>',
    "no quotes": HEAD + "<link name=«a»/>\n</robot>",
    "an attribute twice": HEAD + '<link name="a" «name»="b"/>\n</robot>',
    "a bracket in a value": HEAD + '<!-- ü中 --><link name="ü«<»a"/>\n</robot>',
    "quotes that are not closed": HEAD + '<link «name="»a/>\n <link name="b"/>\n</robot>',
    "no blank": HEAD + '<link name="a"«foo»="b"/>\n</robot>',
    "a start tag that is not closed": HEAD + '<«link» name="a"\n  <joint name="b"/>\n</robot>',
    "an end tag that is not closed": HEAD + '<link name="a">\n</«link»\n<joint name="b"/>\n</robot>',
    "a second root": HEAD + "</robot>\n«<robot»/>",
    "a control character": HEAD + '<link name="a«\x01»"/>\n</robot>',
    "an entity": HEAD + '<link name="a«&nbsp;»b"/>\n</robot>',
    "no value": HEAD + "<link «name» />\n</robot>",
    "text before all": "«hello»\n<robot/>",
    "an attribute of an end tag": HEAD + '<link>\n</link «name»="a">\n</robot>',
    "the file was cut": HEAD + "<link «nam»",
    "a comment that is not closed": HEAD + "<!-- a -->«<!--» abc <!-- d\n <link/>\n</robot>",
    "a section that is not closed": HEAD + "«<![CDATA[» abc\n <link/>\n</robot>",
    "a document type": '<?xml version="1.0"?>\n <!-- <!DOCTYPE a> --> «<!DOCTYPE» robot>\n<robot name="r"/>',
}
REPAIRED = {
    "hyphens": HEAD + '<!-- a «--» b --> <link name="a"/>\n</robot>',
    "a late declaration": '\n  «<?xml» version="1.0"?>\n<robot name="r"><link name="a"/></robot>',
    "an unknown version": '<?xml version="«0.0»"?>\n<robot name="r"><link name="a"/></robot>',
    "no version": '«<?xml» encoding="utf-8"?>\n<robot name="r"><link name="a"/></robot>',
    "a prefix of an element": HEAD + '<link name="a"/><gazebo><«gz:foo»>1</gz:foo></gazebo></robot>',
    "a prefix of an attribute": HEAD + '<link\n name="a"\n  «gz:b»="1"/></robot>',
    "two colons": HEAD + '<link name="a"/><gazebo><«gz::»foo xmlns:gz="u">1</gz::foo></gazebo></robot>',
}
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16"]


def place_of(marked: str) -> tuple[str, tuple[int, int, int, int]]:
    """The text, and where its piece is."""
    begin, end = marked.index("«"), marked.index("»") - 1
    text = marked.replace("«", "").replace("»", "")
    line, start = text.count("\n", 0, begin) + 1, text.rfind("\n", 0, begin)
    return text, (line, begin - start, line, end - start)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", [*REFUSED, *REPAIRED])
def test_an_error_is_at_its_piece(name: str, encoding: str) -> None:
    if encoding == "utf-16" and name in {"no version", "two colons"}:
        return  # which is refused there
    text, place = place_of((REFUSED | REPAIRED)[name])
    for data in (text, text.replace("\n", "\r\n")):
        found = located(twinform.check(data.encode(encoding), name="r"))
        rules = {"not-well-formed", "doctype"} if name in REFUSED else {"repaired-xml"}
        places = [tuple(each.location[1:2] + each.location[3:]) for each in found if each.rule.name in rules]
        assert place in places


def test_bytes_that_are_no_text_are_where_they_are() -> None:
    (found,) = twinform.check('<robot>\n <!-- ü --><link name="'.encode() + b'\xff"/></robot>', name="r").diagnostics
    assert found.location[1:2] + found.location[3:] == (2, 24, 2, 25)


@pytest.mark.parametrize("error", [XmlError(99, 1, "", None), XmlError(1, 999, "", None), XmlError(0, 0, "x", None)])
def test_a_place_that_there_is_not_has_no_column(error: XmlError) -> None:
    assert SyntaxPlaces(b"<a/>").location(error)[3:] == (0, 0, 0)
