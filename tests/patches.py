"""What has to hold for the patch of any text, whatever was changed in its tree."""

import random

from lxml import etree

from tests.tree_changes import PARSER, changed
from twinform.schemas import XmlElement
from twinform.text import SourceText, merge, patch, spans
from twinform.text.alignment import ElementContents, elements


def assert_patched(data: bytes, chance: random.Random, times: int) -> None:
    """After some changes the text says what the tree says, and outside of the element around them nothing differs."""
    before = etree.fromstring(data, PARSER)
    after = changed(before, chance, times)
    source = SourceText.of(data)
    made = patch(source, before, after)
    contents = ElementContents()
    assert contents.number(etree.fromstring(made.data, PARSER)) == contents.number(after)
    merged = merge(before, after, before)
    assert not merged.conflicts
    assert contents.number(merged.tree) == contents.number(after)
    if contents.number(before) == contents.number(after):
        assert made.data == data
    _assert_rest_is_same(source, made, _around(before, after, contents), before)


def _around(before: XmlElement, after: XmlElement, contents: ElementContents) -> XmlElement:
    """The innermost element with all that differs."""
    while before.tag == after.tag and dict(before.attrib) == dict(after.attrib):
        old, new = elements(before), elements(after)
        if [each.tag for each in old] != [each.tag for each in new] or before.text != after.text:
            break
        differ = [pair for pair in zip(old, new, strict=True) if contents.number(pair[0]) != contents.number(pair[1])]
        if len(differ) != 1:
            break
        ((before, after),) = differ
    return before


def _assert_rest_is_same(old: SourceText, new: SourceText, around: XmlElement, root: XmlElement) -> None:
    places = dict(zip(root.iter("*"), spans(old.text).walk(), strict=True))
    start, end = places[around].whole
    assert new.text[:start] == old.text[:start]
    rest = len(old.text) - end
    assert new.text[len(new.text) - rest :] == old.text[end:]
    assert (new.mark, new.encoding) == (old.mark, old.encoding)
