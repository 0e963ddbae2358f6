"""What is not XML is refused at its line, with the way to fix it; what can only mean one thing is repaired."""

from typing import NamedTuple

import pytest
from lxml import etree

import twinform
from twinform.compiler import LoadResult
from twinform.compiler.input.xml_recovery import XmlError, first_fatal, repaired, with_bracket
from twinform.diagnostics import Diagnostic, Location


class Case(NamedTuple):
    """A text, the line that is wrong, and a part of the help."""

    text: str | bytes
    line: int
    help: str


HEAD = "<robot name='r'>\n"

REFUSED = {
    "a value without quotes": Case(HEAD + "<link name=a/>\n</robot>", 2, "put the value of the attribute in quotes"),
    "quotes that are not closed": Case(HEAD + "<link name='a/>\n</robot>", 2, "close the quotes"),
    "an attribute without a value": Case(HEAD + "<link name/>\n</robot>", 2, "give the attribute a value"),
    "an attribute without a value in the only line": Case("<robot a/>\n", 1, "give the attribute a value"),
    "an end tag with an attribute in the last line": Case(HEAD + "</robot a>\n \n", 2, "has no attributes"),
    "an attribute twice": Case(HEAD + "<link name='a' name='b'/>\n</robot>", 2, "delete one of the two"),
    "no blank between attributes": Case(HEAD + "<link name='a'type='b'/>\n</robot>", 2, "put a blank"),
    "another end tag": Case(HEAD + "<link name='a'>\n</lnik>\n</robot>", 3, "write </link>"),
    "a missing end tag": Case(HEAD + "<link name='a'>\n</robot>", 3, "before this </robot>"),
    "an end tag with an attribute": Case(HEAD + "<link name='a'></link name='a'>\n</robot>", 2, "has no attributes"),
    "a file cut off between tags": Case(HEAD + "<link name='a'/>\n", 1, "the file ends too early"),
    "a file cut off in a tag": Case(HEAD + "<link na", 2, "in the middle of a tag"),
    "two roots": Case(HEAD + "</robot>\n<robot name='s'/>", 3, "one root element"),
    "text behind the root": Case(HEAD + "</robot>\nthe end", 3, "delete what follows"),
    "text before the root": Case("hello\n" + HEAD + "</robot>", 1, "delete what stands before it"),
    "no XML at all": Case("solid part\nfacet normal 0 0 1", 1, "if this is no model"),
    "a bare ampersand": Case(HEAD + "<link name='a & b'/>\n</robot>", 2, "write & as &amp;"),
    "an unknown entity": Case(HEAD + "<link name='a&nbsp;b'/>\n</robot>", 2, "write the character itself"),
    "a blank behind the bracket": Case(HEAD + "< link name='a'/>\n</robot>", 2, "right behind the '<'"),
    "two colons in an attribute": Case(HEAD + "<link gz::name='a'/>\n</robot>", 2, "one colon"),
    "an open comment": Case(HEAD + "<!-- open\n<link name='a'/>\n</robot>", 2, "close the comment"),
    "an open section": Case(HEAD + "<![CDATA[ open\n</robot>", 2, "close the section"),
    "bytes of another encoding": Case(HEAD.encode() + b"<link name='\xff'/>\n</robot>", 2, "save the file as UTF-8"),
    "an unknown encoding": Case("<?xml version='1.0' encoding='foo'?>\n" + HEAD + "</robot>", 1, "such as UTF-8"),
    "a control character": Case(HEAD + "<link name='\x01'/>\n</robot>", 2, "delete the control character"),
}

REPAIRED = {
    "no bracket before the declaration": Case("?xml version='1.0'?>\n" + HEAD + "<link name='a'/></robot>", 1, "<?xml"),
    "a misspelt declaration": Case("<?xml verison='1.0'?>\n" + HEAD + "<link name='a'/></robot>", 1, "version='1.0'"),
    "a version without quotes": Case("<?xml version=1.0?>\n" + HEAD + "<link name='a'/></robot>", 1, "version='1.0'"),
    "a version that there is not": Case("<?xml version='0.0'?>\n" + HEAD + "<link name='a'/></robot>", 1, "'1.0'"),
    "a late declaration": Case("\n<?xml version='1.0'?>\n" + HEAD + "<link name='a'/></robot>", 2, "very beginning"),
    "hyphens in a comment": Case(HEAD + "<!-- a -- b --><link name='a'/></robot>", 2, "inside a comment"),
    "two colons in a tag": Case(HEAD + "<link name='a'/><k::x xmlns:k='urn:k'> </k::x></robot>", 2, "one colon"),
    "an undeclared prefix": Case(HEAD + "<link name='a' x:y='1'/></robot>", 2, "declare the prefix"),
}


def check(case: Case) -> LoadResult:
    return twinform.check(case.text if isinstance(case.text, bytes) else case.text.encode())


@pytest.mark.parametrize("case", REFUSED.values(), ids=REFUSED)
def test_it_is_refused_with_the_way_to_fix_it(case: Case):
    loaded = check(case)
    assert loaded.unreadable
    (found,) = loaded.diagnostics
    assert (found.rule.name, found.location.line) == ("not-well-formed", case.line)
    assert case.help in (found.help or "")


@pytest.mark.parametrize("case", REPAIRED.values(), ids=REPAIRED)
def test_it_is_repaired_with_a_warning(case: Case):
    loaded = check(case)
    assert loaded.document
    assert [link.name for link in loaded.document.models[0].links] == ["a"]
    (found,) = loaded.diagnostics
    assert (found.rule.name, found.location.line) == ("repaired-xml", case.line)
    assert case.help in (found.help or "")


def findings(text: bytes) -> list[Diagnostic]:
    """All findings of a text, without their rule and severity, which belong together."""
    return list(twinform.check(text, name="r.urdf").diagnostics)


def test_what_is_refused_reports_where_in_the_line() -> None:
    (found,) = findings(b"<robot>\n  <link name='a'></lnik>\n</robot>")
    assert found.location == Location("r.urdf", 2, "/", 20, 2, 24)
    assert found.message == "not well-formed XML: </lnik> ends the <link> of line 2"
    assert found.help == "write </link>"
    assert found.is_error


def test_what_libxml2_gives_up_is_too_large() -> None:
    (found,) = findings(b"<a>\n" * 300)
    assert (found.rule.name, found.location.path, found.help) == ("oversized-file", "/", None)
    assert found.location.line in {257, 258}  # libxml2 before 2.14 takes one more
    assert found.message.startswith(
        "elements are more than 256 deep, a text has more than 10 MB, or entities make more of it than they are (column"
    )


def test_a_lost_bracket_is_put_back_where_it_was() -> None:
    found = findings(b"\n\n ?xml version='1.0'?>\n<robot name='r'><link name='a'/></robot>")
    assert [(each.rule.name, each.location, each.message, each.help) for each in found] == [
        ("repaired-xml", Location("r.urdf", 3, "/"), f"not well-formed XML, repaired: {what}", help)
        for what, help in (
            ("the '<' of the XML declaration is missing", "write <?xml, with the '<', at the beginning"),
            (
                "<?xml ...?> does not stand at the very beginning of the file",
                "move <?xml ...?> to the very beginning of the file",
            ),
        )
    ]


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        (b"?xml?><r/>", b"<?xml?><r/>"),
        (b" \n?xml?><r/>", b" \n<?xml?><r/>"),
        (b"\xef\xbb\xbf ?xml?><r a='?xml'/>", b"\xef\xbb\xbf <?xml?><r a='?xml'/>"),
        (b"<?xml?><r/>", None),
        (b"<r>?xml</r>", None),
        (b"", None),
    ],
)
def test_only_the_bracket_of_a_declaration_can_be_lost(text: bytes, whole: bytes | None) -> None:
    assert with_bracket(text) == whole


class Logged(NamedTuple):
    """An entry as libxml2 would log it."""

    type_name: str
    line: int = 1
    column: int = 1
    message: str = " reason \n"
    level: int = etree.ErrorLevels.FATAL


LATE = Logged("ERR_RESERVED_XML_NAME", 1, 6)
NO_VERSION = Logged("ERR_VERSION_MISSING", 1, 7)
NO_BLANK = Logged("ERR_SPACE_REQUIRED", 1, 7)

LOGGED: dict[str, tuple[list[Logged], bytes, XmlError | None]] = {
    "nothing": ([], b"<r/>", None),
    "what is fixed": ([LATE, NO_VERSION], b"<r/>", None),
    "what follows from what is fixed": ([NO_BLANK, NO_VERSION, NO_BLANK], b"<r/>", None),
    "the same elsewhere": (
        [LATE, NO_VERSION, NO_BLANK._replace(column=8)],
        b"<r/>",
        XmlError(1, 8, "reason", "put a blank between attributes"),
    ),
    "the same of another slip": ([NO_BLANK], b"<r/>", XmlError(1, 7, "reason", "put a blank between attributes")),
    "the first of two": (
        [Logged("ERR_GT_REQUIRED", 2, 3), Logged("ERR_CDATA_NOT_FINISHED", 1, 1)],
        b"<r\n>\n<s",
        XmlError(2, 3, "reason", "close the tag with '>'; an end tag has no attributes"),
    ),
    "the end of what is cut off": (
        [Logged("ERR_GT_REQUIRED", 3, 3)],
        b"<r>\n</r>\n</ \n \n",
        XmlError(3, 3, "reason", "the file ends in the middle of a tag: it was cut off"),
    ),
    "the end of what is whole": (
        [Logged("ERR_ATTRIBUTE_WITHOUT_VALUE", 2, 5)],
        b"\n<r a/>\n",
        XmlError(2, 5, "reason", "give the attribute a value in quotes: name='value'"),
    ),
    "another slip at the end": (
        [Logged("ERR_TAG_NOT_FINISHED", 1, 3)],
        b"<r",
        XmlError(1, 3, "reason", "the file ends too early: it was cut off, or the last end tags are missing"),
    ),
    "the last comment that is open": (
        [Logged("ERR_COMMENT_NOT_FINISHED", 5, 2)],
        b"<!-- a -->\n<r>\n\n<!-- b\n</r>",
        XmlError(4, 2, "reason", "close the comment with -->"),
    ),
    "a mismatch with another message": (
        [Logged("ERR_TAG_NAME_MISMATCH")],
        b"<r></s>",
        XmlError(1, 1, "reason", "let every end tag repeat the name of its start tag"),
    ),
    "a name that is no entity's": (
        [Logged("ERR_NAME_REQUIRED")],
        b"< r/>",
        XmlError(1, 1, "reason", "write the name right behind the '<'; a '<' that is meant as text is written &lt;"),
    ),
    "an end tag behind the root": (
        [Logged("ERR_DOCUMENT_END", 2)],
        b"<r/><s/>\n \n</r>\n<s/>",
        XmlError(2, 1, "reason", "delete what follows the end tag of the root element"),
    ),
    "an element below the root": (
        [Logged("ERR_DOCUMENT_END", 2)],
        b"<r/>\n \n <s/>\n</r>",
        XmlError(2, 1, "reason", "a file holds one root element: move the second one into a file of its own"),
    ),
    "what nobody has advice for": ([Logged("ERR_PI_NOT_FINISHED", 7, 8)], b"<?a", XmlError(7, 8, "reason", None)),
}


@pytest.mark.parametrize("name", LOGGED)
def test_the_first_doubt_is_what_is_wrong(name: str) -> None:
    log, text, flaw = LOGGED[name]
    found = first_fatal(iter(log), text)
    assert (found._replace(kind="") if found else None) == flaw


def test_what_is_repaired_is_all_that_can_be() -> None:
    assert repaired(iter([LATE, NO_BLANK, NO_VERSION])) == [
        XmlError(1, 6, "reason", "move <?xml ...?> to the very beginning of the file", "ERR_RESERVED_XML_NAME"),
        XmlError(1, 7, "reason", "write <?xml version='1.0'?>", "ERR_VERSION_MISSING"),
    ]


@pytest.mark.parametrize("harmless", ["<!-- -- -->\n", "<!-- ------------ -->\n", "<k:x a='1'/>\n", "<!-- a --->\n"])
@pytest.mark.parametrize("wrong", ["", "<link name='b'></joint>\n"])
def test_what_is_wrong_is_found_behind_any_number_of_harmless_errors(harmless: str, wrong: str) -> None:
    """libxml2 lists a hundred errors: a wrong end tag behind a hundred hyphens in comments was accepted."""
    checked = twinform.check(f"{HEAD}<link name='a'/>\n{harmless * 101}{wrong}</robot>".encode())
    found = [each.location.line for each in checked.diagnostics if each.rule.name == "not-well-formed"]
    assert found == ([104] if wrong else [])


def test_more_late_declarations_than_are_listed_are_refused() -> None:
    checked = twinform.check((HEAD + "<?xml version='1.0'?>" * 101 + "</robot>").encode())
    assert [each.rule.name for each in checked.diagnostics] == ["not-well-formed"]
