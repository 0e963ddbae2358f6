"""What has to hold for the comments of any file, whatever it becomes."""

import re
from collections import Counter
from typing import cast

from lxml import etree

import twinform
from twinform.compiler import Conversion
from twinform.ir.changes import changes
from twinform.request_options import Language
from twinform.schemas import XmlElement

OTHER: dict[str, Language] = {"urdf": "sdf", "sdf": "urdf"}
_PARSER = etree.XMLParser(recover=True)
_BARE = etree.XMLParser(remove_comments=True)
_HYPHENS = re.compile("-(?=-)")


def comments(data: bytes) -> Counter[str]:
    """The comments of a text, without their layout; two hyphens are fixed, which other parsers let pass."""
    root = etree.fromstring(data, _PARSER)
    found = cast("list[XmlElement]", root.getroottree().xpath("//comment()"))
    return Counter(" ".join(_HYPHENS.sub("- ", each.text or "").split()) for each in found)


def assert_comments_kept(data: bytes, made: Conversion, without: Conversion) -> None:
    """Each is there once, or the ledger has it; and nothing else differs from a conversion without them."""
    left = sum(entry.rule.name == "left-comment" for entry in made.ledger.entries)
    before, after = comments(data), comments(made.text.encode())
    assert not after - before
    assert (before - after).total() == left
    assert not [*changes(made.document, without.document)]
    assert _content(made.text) == _content(without.text)


def assert_comments_travel(data: bytes, own: Language) -> None:
    """They are kept within the format, to the other one and back."""
    for to in (own, OTHER[own]):
        made = twinform.convert(data, to=to)
        assert_comments_kept(data, made, twinform.convert(data, to=to, comments=False))
        there = made.text.encode()
        assert comments(twinform.convert(there, to=own).text.encode()) == comments(there)


def _content(text: str) -> list[object]:
    root = etree.fromstring(text.encode(), _BARE)
    return [(each.tag, dict(each.attrib), _stripped(each.text), _stripped(each.tail)) for each in root.iter()]


def _stripped(text: str | None) -> str:
    return (text or "").strip()
