"""What is said about a text that is not XML: no word of the parser's."""

import pytest

import twinform

ROBOT = """<robot name="r">
  <link name="a">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
  </link>
</robot>
"""
DECLARATION = "the declaration <?xml of line 1 is not complete"
CASES = {
    "a quote that is not closed": ('"a">', '"a>', 2, "the value of 'name' in <link> has no closing quote"),
    "a quote that another one ends": (
        'size="1 1 1"',
        'size="1 1 1 x="2"',
        3,
        "the value of 'size' in <box> has no closing quote",
    ),
    "no quotes": ('name="a"', "name=a", 2, "the value of 'name' in <link> has no quotes"),
    "no blank": (
        'name="a"',
        'name="a"x="1"',
        2,
        "there is no blank between two attributes of <link>, or a value lacks its closing quote",
    ),
    "a comma": ('name="a"', 'name="a",', 2, "',' stands behind an attribute of <link>"),
    "a tag that is not closed": ('"a">', '"a"', 2, "<link of line 2 needs > or />"),
    "an empty tag that is not closed": ('1"/>', '1"', 3, "<box of line 3 needs > or />"),
    "an end tag that is not closed": ("</link>", "</link", 4, "</link of line 4 needs >"),
    "a root that is not closed": ("</robot>\n", "", 1, "<robot> of line 1 is never closed"),
    "an element that is not closed": ("</link>", "", 5, "<link> of line 2 is not closed before </robot>"),
    "another case": ("</link>", "</Link>", 4, "</Link> ends the <link> of line 2"),
    "an end tag too many": ("</robot>", "</link></robot>", 5, "</link> ends nothing: <robot> of line 1 is open here"),
    "an ampersand": ('"a"', '"a & b"', 2, "'&' is written &amp; in XML"),
    "an entity": ('"a"', '"&nbsp;"', 2, "&nbsp; is not known to XML"),
    "a bracket in a text": ("</link>", "1 < 2</link>", 4, "no name follows the '<' of line 4 in <link>"),
    "a bracket in a value": ('"a"', '"a<b"', 2, "'<' stands in the value of 'name' in <link>"),
    "a slash": ("<visual>", "<visual/ x='1'>", 3, "'/' stands where <visual> can have an attribute"),
    "a slash that ends no tag": ("/>", "/", 3, "<box/ of line 3 needs >"),
    "a prefix alone": ("<visual>", "<visual><a:", 3, "no name follows <a: of line 3"),
    "a declaration that is not complete": ("<robot", '<?xml version="1.0\n<robot', 1, DECLARATION),
    "an instruction that is not closed": ("</link>", "<?pi </link>", 4, "<?pi of line 4 is never closed"),
    "no value at the end of a line": ('="a"', "=\n", 2, "the value of 'name' in <link> has no quotes"),
    "an attribute twice": ('name="a"', 'name="a" name="b"', 2, "<link> has the attribute 'name' twice"),
    "no value": ('name="a"', "name", 2, "the attribute 'name' of <link> has no value"),
    "something behind the root": ("</robot>", "</robot>x", 5, "something follows the end tag of the root element"),
    "a comment": ("</link>", "<!-- </link>", 4, "the comment that begins here is never closed"),
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_wrong_is_said_in_words_for_everybody(name: str) -> None:
    old, new, line, words = CASES[name]
    found = twinform.check(ROBOT.replace(old, new).encode(), name="r.urdf").diagnostics[0]
    assert (found.location.line, found.message) == (line, f"not well-formed XML: {words}")
