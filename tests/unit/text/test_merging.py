"""Three-way merges: what changed between two trees, the tree as a person wrote it, and what it becomes."""

import pytest
from lxml import etree

from twinform.text import merge

CASES = {
    "a value": ('<a x="1" y="2"/>', '<a x="1" y="3"/>', '<a y="2.0" x="1.0"/>', '<a y="3" x="1.0"/>'),
    "the same change on both sides": ('<a x="1"/>', '<a x="2"/>', '<a x="2.0"/>', '<a x="2.0"/>'),
    "an attribute that goes": ('<a x="1"/>', "<a/>", '<a x="1.0" z="1"/>', '<a z="1"/>'),
    "a text": ("<a><b>1 0</b></a>", "<a><b>2 0</b></a>", "<a><b> 1.0  0 </b></a>", "<a><b>2 0</b></a>"),
    "a child that comes": (
        '<a><b name="x"/><b name="y"/></a>',
        '<a><b name="x"/><c/><b name="y"/></a>',
        '<a><z/><b name="x" v="1"/><b name="y"/></a>',
        '<a><z/><b name="x" v="1"/><c/><b name="y"/></a>',
    ),
    "a child that goes": ('<a><b v="1"/><c/></a>', "<a><c/></a>", '<a><b v="1.0"/><z/><c/></a>', "<a><z/><c/></a>"),
    "a child that goes on both sides": ("<a><b/><c/></a>", "<a><c/></a>", "<a><c/></a>", "<a><c/></a>"),
    "a child that came on both sides": ("<a/>", '<a><b v="1"/></a>', '<a><b v="1.0"/></a>', '<a><b v="1.0"/></a>'),
    "a child that moves keeps its spelling": (
        '<a><b v="1"/><c/><d/></a>',
        '<a><c/><d/><b v="1"/></a>',
        '<a><b v="1.0"/><c/><d/></a>',
        '<a><c/><d/><b v="1.0"/></a>',
    ),
    "names in another order": (
        '<a><b name="x" v="1"/><c name="x"/><b name="y" v="1"/><c name="y"/></a>',
        '<a><b name="x" v="1"/><c name="x"/><b name="y" v="2"/><c name="y"/></a>',
        '<a><c name="x"/><b name="x" w="0" v="1.0"/><c name="y"/><b name="y" w="0" v="1.0"/></a>',
        '<a><c name="x"/><b name="x" w="0" v="1.0"/><c name="y"/><b name="y" w="0" v="2"/></a>',
    ),
    "text between elements": ("<a>1<b/>2</a>", "<a>1<c/>3</a>", '<a z="1">1<b/>2</a>', '<a z="1">1<c/>3</a>'),
    "text between elements that comes": ("<a><b/></a>", "<a>1<b/>3</a>", "<a><b/></a>", "<a>1<b/>3</a>"),
    "a new name": (
        '<a><b name="x" v="1"/></a>',
        '<a><b name="y" v="1"/></a>',
        '<a><b name="x" v="1.0"/></a>',
        '<a><b name="y" v="1.0"/></a>',
    ),
}

CONFLICTS = {
    "a value": ('<a x="1"/>', '<a x="2"/>', '<a x="3"/>', "x of <a> was '1', is '3' here, and becomes '2'"),
    "a value that is gone": ('<a x="1"/>', '<a x="2"/>', "<a/>", "x of <a> was '1', is absent here, and becomes '2'"),
    "a text": ("<a>1</a>", "<a>2</a>", "<a>3</a>", "the text of <a> was '1', is '3' here, and becomes '2'"),
    "text between elements": ("<a>1<b/>2</a>", "<a>1<b/>3</a>", "<a>1<b/>4</a>", "what is in <a> has changed here too"),
    "deleted, and changed here": (
        '<a><b name="x"><c/></b></a>',
        "<a/>",
        '<a><b name="x"><d/></b></a>',
        "<b> 'x' is deleted, and has been changed here",
    ),
    "changed, and deleted here": (
        '<a><b name="x"><c/></b></a>',
        '<a><b name="x"><d/></b></a>',
        "<a/>",
        "<b> 'x' has changed, and is not there",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_changes_are_made_in_what_a_person_wrote(name: str) -> None:
    before, after, own, expected = map(etree.fromstring, CASES[name])
    merged = merge(before, after, own)
    assert merged.conflicts == ()
    assert etree.tostring(merged.tree) == etree.tostring(expected)


@pytest.mark.parametrize("name", CONFLICTS)
def test_what_both_have_changed_is_a_conflict(name: str) -> None:
    *trees, message = CONFLICTS[name]
    merged = merge(*map(etree.fromstring, trees))
    assert [conflict.message for conflict in merged.conflicts] == [message]


SAME = {
    "a value": ('<a x="1"/>', '<a x="2"/>', "<a/>", '<a x="2"/>'),
    "another value": ('<a x="-3.14"/>', '<a x="2"/>', '<a x="3.14"/>', '<a x="2"/>'),
    "an attribute that is not there": ('<a x="1"/>', "<a/>", "<a/>", "<a/>"),
    "a text": ("<a>1</a>", "<a>2</a>", "<a>one</a>", "<a>2</a>"),
    "a child that only one has": ("<a><b/><c>1</c></a>", "<a><b/><c>2</c></a>", "<a><b/></a>", "<a><b/><c>2</c></a>"),
    "a child that goes": ("<a><b/><c>1</c></a>", "<a><b/></a>", "<a><b/><c>one</c></a>", "<a><b/></a>"),
}


@pytest.mark.parametrize("name", SAME)
def test_there_are_no_conflicts_with_what_says_the_same(name: str) -> None:
    before, after, own, expected = map(etree.fromstring, SAME[name])
    merged = merge(before, after, own, same=True)
    assert merged.conflicts == ()
    assert etree.tostring(merged.tree) == etree.tostring(expected)


@pytest.mark.parametrize("name", CASES)
def test_nothing_changed_and_nothing_touched(name: str) -> None:
    before, _, own, _ = map(etree.fromstring, CASES[name])
    merged = merge(before, before, own)
    assert (etree.tostring(merged.tree), merged.conflicts) == (etree.tostring(own), ())


ADDED_UP = {
    "one of several that stand for one": (
        '<a><g r="x"><b/></g><g r="x"><c v="1"/></g></a>',
        '<a><g r="x"><b/></g><g r="x"><c v="2"/></g></a>',
        '<a><g r="x"><c v="1.0"/><!-- here --><b/></g></a>',
        '<a><g r="x"><c v="2"/><!-- here --><b/></g></a>',
    ),
    "one that stands for several": (
        '<a><g r="x"><b/><c v="1"/></g></a>',
        '<a><g r="x"><b/><c v="2"/></g></a>',
        '<a><g r="x"><c v="1.0"/></g><g r="y"/><g r="x"><b/></g></a>',
        '<a><g r="x"><c v="2"/></g><g r="y"/><g r="x"><b/></g></a>',
    ),
    "a part goes, the others stay": (
        '<a><g r="x"><b/></g><g r="x"><c v="1"/></g></a>',
        '<a><g r="x"><b/></g></a>',
        '<a><g r="x"><b/><c v="1.0"/></g></a>',
        '<a><g r="x"><b/></g></a>',
    ),
    "all go": ('<a><g r="x"><b/><c/></g></a>', "<a/>", '<a><g r="x"><c/></g><z/><g r="x"><b/></g></a>', "<a><z/></a>"),
}


@pytest.mark.parametrize("same", [True, False])
@pytest.mark.parametrize("name", ADDED_UP)
def test_parts_that_add_up(name: str, same: bool) -> None:
    before, after, own, expected = (
        etree.fromstring(text.replace("r=", "reference=").replace("<g", "<gazebo").replace("</g>", "</gazebo>"))
        for text in ADDED_UP[name]
    )
    found = merge(before, after, own, same=same, additive="gazebo")
    assert not found.conflicts
    assert etree.tostring(found.tree) == etree.tostring(expected)
