"""The judge of identity must see every loss, and nothing where there is none."""

import pytest

from testbed.oracles.xml_trees import first_difference, is_well_formed

SAME = {
    "white space between elements": ("<a><b/><c/></a>", "<a>\n  <b/>\n\n  <c/>\n</a>"),
    "white space in text": ("<a><pose> 0  0\n1 </pose></a>", "<a><pose>0 0 1</pose></a>"),
    "white space in attributes": ("<a xyz=' 0  0 1'/>", "<a xyz='0 0 1'/>"),
    "comments": ("<a><!-- one --><b>1<!-- two --></b></a>", "<a><b>1</b></a>"),
    "processing instructions": ("<?xml version='1.0'?><a><?p x?></a>", "<a/>"),
    "number spelling": ("<a x='1.0 1e0 +1 .5 -0'>1.50</a>", "<a x='1 1 1 0.5 0'>1.5</a>"),
    "order of attributes": ("<a x='1' y='2'/>", "<a y='2' x='1'/>"),
    "order of different siblings": ("<a><b/><c/></a>", "<a><c/><b/></a>"),
    "character data sections": ("<a><![CDATA[x < y]]></a>", "<a>x &lt; y</a>"),
    "another prefix for one namespace": ("<a xmlns:p='u'><p:b p:c='1'/></a>", "<a xmlns:q='u'><q:b q:c='1'/></a>"),
    "an unused prefix": ("<a xmlns:p='u'/>", "<a/>"),
    "a prefix that the source left unbound": ("<a><gz:p gz:q='1'/></a>", "<a xmlns:gz='u'><gz:p gz:q='1'/></a>"),
    "a default namespace beside an unbound prefix": (
        "<a xmlns='u'><b/><gz:p/></a>",
        "<a xmlns='u' xmlns:gz='v'><b/><gz:p/></a>",
    ),
    "two hyphens in a comment": ("<a><!-- one -- two --><b/></a>", "<a><b/></a>"),
    "a late xml declaration": ("\n<?xml version='1.0'?><a><b/></a>", "<a><b/></a>"),
    "an unknown xml version": ("<?xml version='0.0'?><a><b/></a>", "<a><b/></a>"),
}

DIFFERENT = {
    "another root": ("<a/>", "<b/>", "/a: <a> became <b>"),
    "a lost child": ("<a><b name='x'/><b name='y'/></a>", "<a><b name='x'/></a>", "/a/b[@name='y'] is missing"),
    "a new child": ("<a/>", "<a><b/></a>", "/a/b was added"),
    "a child twice": ("<a><b/></a>", "<a><b/><b/></a>", "/a/b[2] was added"),
    "a lost attribute": ("<a x='1'/>", "<a/>", "/a/@x: '1' is missing"),
    "a new attribute": ("<a/>", "<a x='1'/>", "/a/@x: '1' was added"),
    "another number": ("<a><b>0.1</b></a>", "<a><b>0.10000001</b></a>", "/a/b: text '0.1' became '0.10000001'"),
    "a number less": ("<a>0 0 1</a>", "<a>0 0</a>", "/a: text '0 0 1' became '0 0'"),
    "another boolean": ("<a>1</a>", "<a>true</a>", "/a: text '1' became 'true'"),
    "another case": ("<a>Box</a>", "<a>box</a>", "/a: text 'Box' became 'box'"),
    "a name that looks like a number": ("<a name='1.0'/>", "<a name='1'/>", "/a/@name: '1.0' became '1'"),
    "a reference that looks like a number": ("<child>1.0</child>", "<child>1</child>", "'1.0' became '1'"),
    "equal siblings in another order": (
        "<a><point>0 1</point><point>1 0</point></a>",
        "<a><point>1 0</point><point>0 1</point></a>",
        "/a/point[1]: text",
    ),
    "named siblings in another order": (
        "<a><b name='x'/><b name='y'/></a>",
        "<a><b name='y'/><b name='x'/></a>",
        "@name",
    ),
    "order inside a plugin": (
        "<a><plugin><b/><c/></plugin></a>",
        "<a><plugin><c/><b/></plugin></a>",
        "/a/plugin: the order of the children changed",
    ),
    "order deep inside a gazebo element": (
        "<a><gazebo><s><b/><c/></s></gazebo></a>",
        "<a><gazebo><s><c/><b/></s></gazebo></a>",
        "/a/gazebo/s: the order",
    ),
    "number spelling inside a plugin": (
        "<plugin><id>007</id></plugin>",
        "<plugin><id>7</id></plugin>",
        "'007' became '7'",
    ),
    "text between elements": ("<a>stray<b/></a>", "<a><b/></a>", "/a: text 'stray' became ''"),
    "the default namespace": ("<a xmlns='u'/>", "<a/>", "became <a>"),
    "another namespace": ("<a xmlns:p='u'><p:b/></a>", "<a xmlns:p='v'><p:b/></a>", "{u}b is missing"),
    "a lost prefix": ("<a><gz:p/></a>", "<a><p/></a>", "/a/gz:p is missing"),
    "a difference below a malformed comment": ("<a><!-- -- --><b>1</b></a>", "<a><b>2</b></a>", "/a/b: text"),
}


@pytest.mark.parametrize("case", SAME)
def test_equal_trees_are_equal(case: str):
    source, result = SAME[case]
    assert first_difference(source.encode(), result.encode()) is None


@pytest.mark.parametrize("case", DIFFERENT)
def test_a_difference_is_seen_and_named(case: str):
    source, result, message = DIFFERENT[case]
    assert message in str(first_difference(source.encode(), result.encode()))


@pytest.mark.parametrize("case", DIFFERENT)
def test_a_difference_is_seen_in_the_other_direction_too(case: str):
    source, result, _ = DIFFERENT[case]
    if is_well_formed(source.encode()):
        assert first_difference(result.encode(), source.encode()) is not None


def test_every_file_equals_itself():
    text = (
        b"<sdf version='1.9'><model name='m'><link name='a'><pose degrees='1'>0 0 1 0 0 9</pose></link></model></sdf>"
    )
    assert first_difference(text, text) is None


@pytest.mark.parametrize("text", ["<a>", "<a><b></a></b>", "<a x=1/>", "<a><gz:p/></a>", ""])
def test_malformed_text_is_not_well_formed(text: str):
    assert not is_well_formed(text.encode())
