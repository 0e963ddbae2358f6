"""The smallest edit for each kind of change: what the text was, what the tree becomes, what the text becomes."""

from collections.abc import Callable

import pytest
from lxml import etree

from tests.tree_changes import PARSER
from twinform.diagnostics import TextEdit
from twinform.schemas import XmlElement
from twinform.text import Editor, SourceText, TextSurroundings, apply, patch, spans

_PARSER = etree.XMLParser(remove_comments=True, remove_pis=True)

CASES = {
    "a value keeps its quotes": (
        "<a  x = '1'\n y=\"2\" />",
        '<a x="3&apos;" y="2"/>',
        "<a  x = '3&apos;'\n y=\"2\" />",
    ),
    "an attribute goes with the blanks before it": ('<a x="1"  y="2" z="3"/>', '<a x="1" z="3"/>', '<a x="1" z="3"/>'),
    "an attribute comes behind the others": ('<a x="1"/>', '<a x="1" y="&lt;"/>', '<a x="1" y="&lt;"/>'),
    "attributes on lines of their own": (
        '<a\n  x="1"\n  y="2"/>',
        '<a x="1" y="2" z="3"/>',
        '<a\n  x="1"\n  y="2"\n  z="3"/>',
    ),
    "a first attribute": ("<a />", '<a x="1"/>', '<a x="1" />'),
    "a text keeps the blanks around it": ("<a>\n  1 0 0\n</a>", "<a>2</a>", "<a>\n  2\n</a>"),
    "a text beside a comment": ("<a>1 <!-- kg --></a>", "<a>2</a>", "<a>2 <!-- kg --></a>"),
    "a text in a section": ("<a><![CDATA[<]]></a>", "<a>&amp;</a>", "<a>&amp;</a>"),
    "a text goes": ("<a>1</a>", "<a/>", "<a></a>"),
    "a text comes": ("<a />", "<a>1</a>", "<a>1</a>"),
    "a child goes with its line": ("<a>\n  <b/>\n  <c/>\n</a>", "<a><b/></a>", "<a>\n  <b/>\n</a>"),
    "a comment stays": ("<a>\n  <!-- b -->\n  <b/>\n</a>", "<a/>", "<a>\n  <!-- b -->\n</a>"),
    "the last child goes": ("<a>\n  <b/>\n</a>", "<a/>", "<a/>"),
    "a child is indented like the others": (
        "<a>\n\t<b>\n\t\t<c/>\n\t</b>\n</a>",
        "<a><b><c/></b><b><d/></b></a>",
        "<a>\n\t<b>\n\t\t<c/>\n\t</b>\n\t<b>\n\t\t<d/>\n\t</b>\n</a>",
    ),
    "a comment on the line of an element stays there": (
        "<a>\n  <b/>  <!-- first -->\n</a>",
        "<a><b/><c/></a>",
        "<a>\n  <b/>  <!-- first -->\n  <c/>\n</a>",
    ),
    "a first child": ("<a>\n  <b/>\n</a>", "<a><c/><b/></a>", "<a>\n  <c/>\n  <b/>\n</a>"),
    "children on one line": ("<a><b/> <b x='1'/></a>", "<a><b/><b x='1'/><c/></a>", "<a><b/> <b x='1'/><c/></a>"),
    "children of an element without any": (
        "<r>\n  <a/>\n</r>",
        "<r><a><b/></a></r>",
        "<r>\n  <a>\n    <b/>\n  </a>\n</r>",
    ),
    "line ends are those of the file": ("<a>\r\n  <b/>\r\n</a>", "<a><b/><c/></a>", "<a>\r\n  <b/>\r\n  <c/>\r\n</a>"),
    "what is moved keeps its spelling": (
        "<a>\n  <b  x='1'/>\n  <c/>\n  <d/>\n</a>",
        '<a><c/><d/><b x="1"/></a>',
        "<a>\n  <c/>\n  <d/>\n  <b  x='1'/>\n</a>",
    ),
    "a new name": (
        "<a>\n  <b name='x'> <c/> </b>\n  <b name='y'/>\n</a>",
        "<a><b name='z'><c/></b><b name='y'/></a>",
        "<a>\n  <b name='z'> <c/> </b>\n  <b name='y'/>\n</a>",
    ),
    "a prefix that is declared": (
        '<a xmlns:p="urn:p">\n  <p:b/>\n</a>',
        '<a xmlns:q="urn:p"><q:b/><q:c q:x="1"/></a>',
        '<a xmlns:p="urn:p">\n  <p:b/>\n  <p:c p:x="1"/>\n</a>',
    ),
    "a prefix that is not": (
        "<a>\n  <b/>\n</a>",
        '<a><b/><p:c xmlns:p="urn:p"/></a>',
        '<a>\n  <b/>\n  <p:c xmlns:p="urn:p"/>\n</a>',
    ),
    "text beside elements": ("<a>one <b/> two</a>", "<a>one <b x='1'/> two</a>", '<a>one <b x="1"/> two</a>'),
    "nothing": ("<a  x='1' ><!-- --></a >", '<a x="1"/>', "<a  x='1' ><!-- --></a >"),
}


@pytest.mark.parametrize("name", CASES)
def test_the_smallest_edit(name: str) -> None:
    text, tree, expected = CASES[name]
    source = SourceText.of(text.encode())
    made = patch(source, etree.fromstring(text, _PARSER), etree.fromstring(tree))
    assert made.text == expected


TEXT = """<robot>
\t<link name='a'/> <!-- about a -->
\t<joint  type = 'fixed'   name="j">
\t\t<!-- inside -->
\t\t<child>x</child>
\t</joint>
\t<empty></empty><value> 1 <!-- c --> </value>
</robot>
"""


def _made(change: Callable[[Editor, XmlElement], TextEdit | tuple[TextEdit, ...]], text: str = TEXT) -> str:
    root = etree.fromstring(text.encode(), PARSER)
    source = SourceText.of(text.encode())
    place = spans(text)
    editor = Editor(TextSurroundings.of(source, place), dict(zip(root.iter("*"), place.walk(), strict=True)))
    found = change(editor, root)
    return apply(text, (found,) if isinstance(found, TextEdit) else found)


def _find(root: XmlElement, tag: str) -> XmlElement:
    found = root.find(tag)
    assert found is not None
    return found


_Change = Callable[[Editor, XmlElement], TextEdit | tuple[TextEdit, ...]]
_CHANGES: list[tuple[_Change, str, str]] = [
    (lambda e, r: e.set_attribute(_find(r, "link"), "name", "it's"), "name='a'", "name='it&apos;s'"),
    (lambda e, r: e.set_attribute(_find(r, "link"), "x", "1"), "name='a'", "name='a' x='1'"),
    (lambda e, r: e.set_attribute(_find(r, "empty"), "x", "1"), "<empty>", '<empty x="1">'),
    (lambda e, r: e.set_attribute(_find(r, "joint"), "x", "1"), 'name="j"', 'name="j"   x="1"'),
    (lambda e, r: e.rename_attribute(_find(r, "joint"), "type", "kind"), "type = 'fixed'", "kind = 'fixed'"),
    (lambda e, r: e.remove_attribute(_find(r, "joint"), "type"), "<joint  type = 'fixed'   name", "<joint   name"),
    (lambda e, r: e.rename(_find(r, "link"), "body"), "<link", "<body"),
    (lambda e, r: e.rename(_find(r, "empty"), "full"), "<empty></empty>", "<full></full>"),
    (lambda e, r: e.remove(_find(r, "link")), "\t<link name='a'/> <!--", " <!--"),
    (lambda e, r: e.remove(_find(r, "joint/child")), "\t\t<child>x</child>\n", ""),
    (lambda e, r: e.set_text(_find(r, "value"), "2<3"), "> 1 <", "> 2&lt;3 <"),
    (lambda e, r: e.set_text(_find(r, "empty"), "2"), "<empty></empty>", "<empty>2</empty>"),
    (lambda e, r: e.set_text(_find(r, "link"), "2"), "<link name='a'/>", "<link name='a'>2</link>"),
    (lambda e, r: e.insert(_find(r, "joint"), etree.Element("axis")), "</child>", "</child>\n\t\t<axis/>"),
    (lambda e, r: e.insert(r, etree.Element("x"), _find(r, "link")), "a -->", "a -->\n\t<x/>"),
    (
        lambda e, r: e.insert(_find(r, "link"), etree.Element("x")),
        "<link name='a'/>",
        "<link name='a'>\n\t\t<x/>\n\t</link>",
    ),
]
"""A change, what it replaces, and what by."""


@pytest.mark.parametrize(("change", "old", "new"), _CHANGES)
def test_one_part_is_changed(change: _Change, old: str, new: str) -> None:
    assert TEXT.count(old) == 1
    assert _made(change) == TEXT.replace(old, new)


def test_comments_in_what_is_taken_out_stay() -> None:
    made = _made(lambda editor, root: editor.remove(_find(root, "joint")))
    assert "\t<!-- inside -->\n\t<empty>" in made
    assert "joint" not in made
