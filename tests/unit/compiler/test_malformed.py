"""What is not XML is refused at its line, with the way to mend it; what can only mean one thing is repaired."""

from typing import NamedTuple

import pytest

import twinform
from twinform.compiler import Checked


class Case(NamedTuple):
    """A text, the line that is wrong, and words of the help."""

    text: str | bytes
    line: int
    help: str


HEAD = "<robot name='r'>\n"

REFUSED = {
    "a value without quotes": Case(HEAD + "<link name=a/>\n</robot>", 2, "put the value of the attribute in quotes"),
    "quotes that are not closed": Case(HEAD + "<link name='a/>\n</robot>", 3, "close the quotes"),
    "an attribute without a value": Case(HEAD + "<link name/>\n</robot>", 2, "give the attribute a value"),
    "an attribute twice": Case(HEAD + "<link name='a' name='b'/>\n</robot>", 2, "delete one of the two"),
    "no blank between attributes": Case(HEAD + "<link name='a'type='b'/>\n</robot>", 2, "put a blank"),
    "another end tag": Case(HEAD + "<link name='a'>\n</lnik>\n</robot>", 3, "write </link> for the <link> of line 2"),
    "a missing end tag": Case(HEAD + "<link name='a'>\n</robot>", 3, "before this </robot>"),
    "an end tag with an attribute": Case(HEAD + "<link name='a'></link name='a'>\n</robot>", 2, "has no attributes"),
    "a file cut off between tags": Case(HEAD + "<link name='a'/>\n", 3, "the file ends too early"),
    "a file cut off in a tag": Case(HEAD + "<link na", 2, "in the middle of a tag"),
    "two roots": Case(HEAD + "</robot>\n<robot name='s'/>", 3, "one root element"),
    "text behind the root": Case(HEAD + "</robot>\nthe end", 3, "delete what follows"),
    "text before the root": Case("hello\n" + HEAD + "</robot>", 1, "delete what stands before it"),
    "no XML at all": Case("solid part\nfacet normal 0 0 1", 1, "if this is no model"),
    "a bare ampersand": Case(HEAD + "<link name='a & b'/>\n</robot>", 2, "write & as &amp;"),
    "an unknown entity": Case(HEAD + "<link name='a&nbsp;b'/>\n</robot>", 2, "write the character itself"),
    "a blank behind the bracket": Case(HEAD + "< link name='a'/>\n</robot>", 2, "right behind the '<'"),
    "two colons in an attribute": Case(HEAD + "<link gz::name='a'/>\n</robot>", 2, "one colon"),
    "two colons in a tag": Case(HEAD + "<gz::link name='a'/>\n</robot>", 2, "one colon"),
    "an open comment": Case(HEAD + "<!-- open\n<link name='a'/>\n</robot>", 2, "close the comment"),
    "an open section": Case(HEAD + "<![CDATA[ open\n</robot>", 3, "close the section"),
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
    "an undeclared prefix": Case(HEAD + "<link name='a' x:y='1'/></robot>", 2, "declare the prefix"),
}


def check(case: Case) -> Checked:
    return twinform.check(case.text if isinstance(case.text, bytes) else case.text.encode())


@pytest.mark.parametrize("case", REFUSED.values(), ids=REFUSED)
def test_it_is_refused_with_the_way_to_mend_it(case: Case):
    checked = check(case)
    assert checked.unreadable
    (found,) = checked.diagnostics
    assert (found.rule.name, found.location.line) == ("not-well-formed", case.line)
    assert case.help in (found.help or "")


@pytest.mark.parametrize("case", REPAIRED.values(), ids=REPAIRED)
def test_it_is_repaired_with_a_warning(case: Case):
    checked = check(case)
    assert checked.document
    assert [link.name for link in checked.document.models[0].links] == ["a"]
    (found,) = checked.diagnostics
    assert (found.rule.name, found.location.line) == ("repaired-xml", case.line)
    assert case.help in (found.help or "")
