"""The value types in the XSDs and the parsers are of one mind on every text."""

from functools import cache

import pytest
import xmlschema
from lxml import etree

from generators.schemas import FORMATS
from twinform.schemas import Fact, XmlElement
from twinform.schemas.value_types import VALUE_TYPES
from twinform.schemas.xsd_values import TOKENS, XS, Values, xs

TOO_LARGE = "12345678901234567890"
"""More than an integer of 32 bits can hold, which are those of MuJoCo."""
NUMBERS = "1|-1|+1|007|1.|.5|-.5|1.5|1e5|1E-5|+.5e+3|-0|-0.0|12345678901234567890"
WORD_TEXTS = "true|True|TRUE|tRuE|false|FALSE|inf|-inf|+INF|Inf|nan|-NaN|infinity|yes|on|abc|tru|None"
NEARLY_NUMBERS = ".|-|+|e5|1e|1e+|--1|+-1|+-inf|1_0|1,5|0x|1f|1.5.2|1 e5|0b1|0o7|1d|one|0x1p3|inf1|nan(1)"
HEXADECIMAL = "0x1F|0X1f|-0x1|+0xff|-0x0|-0X00|0xG|0x 1|x1"
MANY = (
    "1 2|1 2 3|1 2 3 4|1 2 3 4 5|0 0 0 0 0 0|0 0 0 0 0 0 1|1 1 1 1 1 1 1 1|1,2,3|1;2;3|inf 0 nan|1 2 x|0 0 0 0 0 inf"
    "|0x1 0x2|1 inf|1  2   3|.1 .2 .3 1.|1 2 3e|-1 -2|1.5 2|a b c"
)
PADDED = [" 1 ", "\t1\n", "\n 1\n\t2 3 ", "  true ", "1\r2", " ", "\n\t ", ""]
FOREIGN_BLANKS = ["\u00a01", "1\u00a0", "1\u00a02\u00a03", "inf\u20032 3", "1\u20282", "\u00a0true", "\u00a0", "\u0661"]
TEXTS = [text for group in (NUMBERS, WORD_TEXTS, NEARLY_NUMBERS, HEXADECIMAL, MANY) for text in group.split("|")]


@cache
def _schema_of_values(name: str) -> str:
    """A schema with one attribute and one leaf for each value type."""
    schema = etree.Element(XS + "schema", nsmap={"xs": XS[1:-1]})
    values = Values(name)
    holder = xs(xs(schema, "element", name="values"), "complexType")
    choice = xs(holder, "choice", minOccurs="0", maxOccurs="unbounded")
    for word in TOKENS[name]:
        values.leaf(Fact(word, type=word, default="0"), xs(choice, "element", name=word))
        needed = xs(choice, "element", name=f"{word}.needed")
        values.leaf(Fact(word, type=word), needed)
        values.attribute(Fact(word, type=word), xs(holder, "attribute", name=word))
    values.declare(schema)
    return etree.tostring(schema, encoding="unicode")


@cache
def _reference(name: str) -> xmlschema.XMLSchema11:
    return xmlschema.XMLSchema11(_schema_of_values(name), allow="none")


def _parses(name: str, word: str, text: str) -> bool:
    try:
        VALUE_TYPES[name][word].parse(text)
    except ValueError:
        return False
    return True


def _holders(word: str, text: str) -> list[XmlElement]:
    """The text as an attribute, a leaf that must not be blank, and one that may be."""
    roots = [etree.Element("values", {word: text}), etree.Element("values"), etree.Element("values")]
    etree.SubElement(roots[1], f"{word}.needed").text = text
    etree.SubElement(roots[2], word).text = text
    return roots


@pytest.mark.parametrize("name", FORMATS)
def test_every_value_type_but_text_has_a_pattern(name: str):
    assert TOKENS[name].keys() == VALUE_TYPES[name].keys() - {"string"}


@pytest.mark.parametrize(("name", "word"), [(name, word) for name in FORMATS for word in TOKENS[name]])
def test_patterns_take_what_the_parsers_take(name: str, word: str):
    libxml2 = etree.XMLSchema(etree.fromstring(_schema_of_values(name)))
    reference = _reference(name)
    for text in [*TEXTS, *PADDED]:
        if (name, text) == ("mjcf", TOO_LARGE) and word.startswith("int"):
            continue  # left to the parser: see below
        parses = _parses(name, word, text)
        for root, expected in zip(_holders(word, text), (parses, parses, parses or not text.strip()), strict=True):
            assert libxml2.validate(root) is expected, etree.tostring(root)
            assert reference.is_valid(root) is expected, etree.tostring(root)


@pytest.mark.parametrize(("name", "word"), [(name, word) for name in FORMATS for word in TOKENS[name]])
def test_only_blanks_of_xml_are_blank(name: str, word: str):
    # xmlschema 4.3 is no judge here: it strips and splits as Python does
    libxml2 = etree.XMLSchema(etree.fromstring(_schema_of_values(name)))
    for text in FOREIGN_BLANKS if word != "words" else ():  # a word may have anything else in it
        assert not _parses(name, word, text), text
        assert not any(libxml2.validate(root) for root in _holders(word, text)), text


@pytest.mark.parametrize("name", FORMATS)
def test_a_number_that_no_double_holds_is_left_to_the_parser(name: str):
    libxml2 = etree.XMLSchema(etree.fromstring(_schema_of_values(name)))
    assert libxml2.validate(etree.Element("values", double="1e400"))
    assert not _parses(name, "double", "1e400")


@pytest.mark.parametrize(
    "word", [word for word in TOKENS["mjcf"] if word.startswith("int") and word not in {"int.2", "int.3"}]
)
def test_an_integer_that_mujoco_cannot_hold_is_left_to_the_parser(word: str):
    libxml2 = etree.XMLSchema(etree.fromstring(_schema_of_values("mjcf")))
    for text, holds in ((TOO_LARGE, False), ("2147483648", False), ("2147483647", True), ("-2147483648", True)):
        assert libxml2.validate(etree.Element("values", {word: text}))
        assert _parses("mjcf", word, text) is holds
