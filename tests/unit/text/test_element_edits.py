"""Edits of one part: what they do not say stays."""

from collections.abc import Callable

import pytest
from lxml import etree

from tests.tree_changes import PARSER
from twinform.diagnostics import TextEdit
from twinform.schemas import XmlElement
from twinform.text import Editor, SourceText, TextSurroundings, apply, spans

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
