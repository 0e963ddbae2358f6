"""What has to hold for the format of any text, and texts in random layouts to try it with."""

import random
import re

from lxml import etree

from twinform import Document, dumps
from twinform.compiler import LoadOptions, read
from twinform.ir.changes import changes
from twinform.schemas import XmlElement
from twinform.text import SourceText
from twinform.text.alignment import spelled_alike
from twinform.text.formatting import FormatOptions, format_text

OPTIONS = (FormatOptions(), FormatOptions("\t", "shortest", sort_attributes=True))
ASIDES = (
    "<!-- a -->",
    "\n<!--\n  of two lines\n-->\n",
    "<?an instruction?>",
    "  ",
    "\t<!-- \u2603 -->",
    "\r\n",
    "\n\n\n\n",
)
_GAPS = ("  ", "\n      ", "\t", "\n", "     ", " ")
_GAP = re.compile(r" (?=[\w:]+=\")")
_BLANK = re.compile(r"[ \t\r\n]+")


def assert_formatted(data: bytes, *, is_model: bool) -> None:
    """The text says what it has said, to the reader of XML as to that of models, and is not changed any more."""
    source = SourceText.of(data)
    before = _content(data, values=True)
    loaded = read(data, LoadOptions()) if is_model else None
    document = loaded.document if loaded and loaded.accepted else None
    for options in OPTIONS:
        made = format_text(source, options)
        assert format_text(made, options) == made
        assert (made.encoding, made.mark) == (source.encoding, source.mark)
        is_kept = options.numbers == "kept"
        assert _content(made.data, values=is_kept) == (before if is_kept else _content(data, values=False))
        if document is not None:
            other = read(made.data, LoadOptions()).document
            assert other is not None
            if is_kept:
                assert not [*changes(document, other)]
            else:
                assert _written(other) == _written(document)


def _written(document: Document) -> object:
    """What a document is written as, whatever the spelling of numbers and the order of attributes."""
    root = etree.fromstring(dumps(document).encode())
    values = [sorted((name, str(spelled_alike(value))) for name, value in node.items()) for node in root.iter()]
    return values, [(node.tag, str(spelled_alike(node.text or ""))) for node in root.iter()]


def scattered(text: str, chance: random.Random) -> str:
    """The text with comments, instructions and blanks of any kind behind its tags, and in them."""
    text = text.replace('<?xml version="1.0"?>\n', "")
    text = _GAP.sub(lambda _: chance.choice(_GAPS) if chance.random() < 0.3 else " ", text)
    pieces = [piece + ">" for piece in text.split(">")[:-1]]
    return "".join(piece + (chance.choice(ASIDES) if chance.random() < 0.3 else "") for piece in pieces)


def _content(data: bytes, *, values: bool) -> list[object]:
    """All that a text holds in its order, but for blanks between elements and at the ends of lines in comments."""
    root = etree.fromstring(data, etree.XMLParser(recover=True))
    return [_part(each, values=values) for each in root.getroottree().iter()]


def _part(node: XmlElement, *, values: bool) -> object:
    if not isinstance(node.tag, str):
        lines = [line.lstrip() for line in (node.text or "").split("\n")]
        return str(node)[:2], lines, _text(node.tail)
    attributes = sorted(node.items()) if values else sorted(node.keys())
    return node.tag, attributes, _text(node.text) if values else None, _text(node.tail)


def _text(text: str | None) -> str:
    """A text; blanks are all alike where there is nothing else, or nothing but numbers."""
    if text is None or not text.strip(" \t\r\n"):
        return ""
    return _BLANK.sub(" ", text).strip() if re.fullmatch(r"[-+.\deE\s]+", text, re.ASCII) else text
