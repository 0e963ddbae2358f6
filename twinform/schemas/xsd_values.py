"""The value types of `values.py` as XSD simple types, and the leaves that hold them.

All patterns are linear and none of XSD's own numbers or truth values is used: libxml2 takes "1e" for an xs:double.
Numbers that no double can hold fit the patterns; the parsers refuse them.
"""

import re

from lxml import etree

from twinform.dataclass import dataclass
from twinform.schemas.facts import Fact
from twinform.schemas.value_types import LENGTHS, list_type
from twinform.schemas.xml import XmlElement

XS = "{http://www.w3.org/2001/XMLSchema}"

_FINITE = r"[+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?"
_NUMBER = rf"{_FINITE}|[+\-]?([iI][nN][fF]|[nN][aA][nN])"
# A whole number may have a fraction of zero: the description of a commercial robot has
# `<samples>1.0</samples>`. libsdformat reads the digits at the beginning and drops the rest, so it
# takes 640.7 and 6e2 for 640 and 6; those are errors here.
_INT = r"[+\-]?(0[xX][0-9a-fA-F]+|[0-9]+(\.0*)?)"
_UINT = r"\+?(0[xX][0-9a-fA-F]+|[0-9]+(\.0*)?)|-(0[xX]0+|0+(\.0*)?)"
EXPRESSION = r".*[$][({].*"
"""Text with a value of xacro's in it: `${...}` or `$(...)`."""
_BOOL = "[tT][rR][uU][eE]|[fF][aA][lL][sS][eE]|0|1"


@dataclass(frozen=True, slots=True)
class TokenCount:
    """Text of a number of tokens with one pattern; `most` is None for any number of them.

    `exact` is whether no blanks may stand around a single one.
    """

    pattern: str
    least: int = 1
    most: int | None = 1
    exact: bool = False


_URDF = {
    "bool": TokenCount(_BOOL),
    "int": TokenCount(_INT),
    "uint": TokenCount(_UINT),
    "double": TokenCount(_FINITE),
    "vector3": TokenCount(_FINITE, 3, 3),
    "quaternion": TokenCount(_FINITE, 4, 4),
    "color4": TokenCount(_FINITE, 4, 4),
}

_SDF = _URDF | {
    "double": TokenCount(_NUMBER),
    "vector2d": TokenCount(_FINITE, 2, 2),
    "vector2i": TokenCount(_INT, 2, 2),
    "quaternion": TokenCount(_FINITE, 3, 4),
    "color": TokenCount(_FINITE, 3, 4),
    "pose": TokenCount(_FINITE, 6, 7),
    "time": TokenCount(_FINITE, 1, 2),
}

# MuJoCo takes `infinity` and hexadecimal numbers too, which no file of the corpus has.
_DECIMAL = r"[+\-]?[0-9]+"
_MJCF = {
    "words": TokenCount(r"\S+", 0, None),
    "bool": TokenCount("true|false", exact=True),
    "int": TokenCount(_DECIMAL),
    "double": TokenCount(_NUMBER),
    "vector3": TokenCount(_NUMBER, 3, 3),
    "quaternion": TokenCount(_NUMBER, 4, 4),
    "color4": TokenCount(_NUMBER, 4, 4),
    "doubles": TokenCount(_NUMBER, 0, None),
    "ints": TokenCount(_DECIMAL, 0, None),
    "memory": TokenCount("-1|[0-9]+[KMGTPEkmgtpe]?", exact=True),
    "axes": TokenCount("[xyzXYZ]{3}", exact=True),
    **{list_type("double", *lengths): TokenCount(_NUMBER, *lengths) for lengths in LENGTHS["double"]},
    **{list_type("int", *lengths): TokenCount(_DECIMAL, *lengths) for lengths in LENGTHS["int"]},
}

TOKENS = {"urdf": _URDF, "sdf": _SDF, "mjcf": _MJCF}
"""By format and value type; `string` is any text."""

_WORD = "word"
"""The leaves that enumerations restrict. A restriction keeps only attributes that its base allows, so it allows all."""


def xs(parent: XmlElement, tag: str, /, **attributes: str) -> XmlElement:
    """Append a new XSD element to another."""
    return etree.SubElement(parent, XS + tag, attributes)


class Values:
    """The value types used by one schema; asking for a type puts it on the list to declare."""

    def __init__(self, format: str, *, lenient: bool = False, expressions: bool = False) -> None:
        self.tokens = TOKENS[format]
        self.lenient = lenient
        self.expressions = expressions
        self.used: set[str] = set()
        self.blank: set[str] = set()
        self.leaves: set[str] = set()

    def attribute(self, row: Fact, attribute: XmlElement) -> None:
        """Give an attribute its type; its text is taken as it is, with all blanks."""
        if row.enum:
            self._words(row, xs(attribute, "simpleType"))
        else:
            attribute.set("type", self._value(row.type))

    def leaf(self, row: Fact, element: XmlElement) -> XmlElement | None:
        """Give a leaf its type; if the row has a type of its own, return the extension that its attributes go into."""
        if row.enum or row.attributes or row.needs_text:
            return self.extension(row, xs(element, "complexType"))
        self.leaves.add(row.type or "string")
        element.set("type", f"{row.type}-leaf")
        return None

    def extension(self, row: Fact, complex_type: XmlElement) -> XmlElement:
        """Simple content in a complex type: the extension that attributes go into."""
        content = xs(complex_type, "simpleContent")
        if not row.enum:
            return xs(content, "extension", base=self._text(row.type, needed=row.needs_text))
        self.leaves.add(_WORD)
        restriction = xs(content, "restriction", base=f"{_WORD}-leaf")
        if self.expressions:  # a restriction has no union
            xs(restriction, "pattern", value="|".join((*map(_literally, self._enum(row)), EXPRESSION)))
        else:
            _enumerate(restriction, self._enum(row))
        return restriction

    def declare(self, schema: XmlElement) -> None:
        """Declare the types in a schema that were asked for."""
        for name in sorted(self.leaves):
            content = xs(xs(schema, "complexType", name=f"{name}-leaf"), "simpleContent")
            if name == _WORD:
                allow_attributes(xs(content, "extension", base="xs:token"), "##any")
            else:
                allow_attributes(xs(content, "extension", base=self._text(name)), "##other")
        for name in sorted(self.blank):
            union = xs(schema, "simpleType", name=f"{name}-or-blank")
            xs(union, "union", memberTypes=f"{name}-value blank")
        for name in sorted(self.used):
            self._declare_value(xs(schema, "simpleType", name=f"{name}-value"), self.tokens[name])
        if self.expressions:
            expression = xs(xs(schema, "simpleType", name="expression"), "restriction", base="xs:token")
            xs(expression, "pattern", value=EXPRESSION)
        if self.blank:
            blank = xs(xs(schema, "simpleType", name="blank"), "restriction", base="xs:token")
            xs(blank, "length", value="0")

    def _declare_value(self, simple_type: XmlElement, tokens: TokenCount) -> None:
        if self.expressions:
            union = xs(simple_type, "union", memberTypes="expression")
            _declare_tokens(xs(union, "simpleType"), tokens)
        else:
            _declare_tokens(simple_type, tokens)

    def _words(self, row: Fact, simple_type: XmlElement) -> None:
        """The words of an enumeration, of which there may be a list."""
        if row.type == "words":
            simple_type = xs(xs(simple_type, "list"), "simpleType")
        if self.expressions:
            simple_type = xs(xs(simple_type, "union", memberTypes="expression"), "simpleType")
        _enumerate(xs(simple_type, "restriction", base="xs:string"), self._enum(row))

    def _enum(self, row: Fact) -> tuple[str, ...]:
        """Return the values of an enumeration; in a lenient schema also those of dialects and other versions."""
        others = (*(word for word, _ in row.also), *row.elsewhere) if self.lenient else ()
        return (*row.enum, *others)

    def _value(self, name: str | None) -> str:
        if name is None or name == "string":
            return "xs:string"
        self.used.add(name)
        return f"{name}-value"

    def _text(self, name: str | None, *, needed: bool = False) -> str:
        value = self._value(name)
        if value == "xs:string" or needed:
            return value
        self.blank.add(name or "string")
        return f"{name}-or-blank"


def annotate(text: str, element: XmlElement) -> None:
    """Document an element or attribute for editors and people."""
    if text:
        annotation = etree.Element(XS + "annotation")
        element.insert(0, annotation)
        xs(annotation, "documentation").text = text


def allow_attributes(holder: XmlElement, namespace: str) -> None:
    """Let an element carry attributes that are not checked."""
    xs(holder, "anyAttribute", namespace=namespace, processContents="skip")


def _enumerate(restriction: XmlElement, words: tuple[str, ...]) -> None:
    for word in words:
        xs(restriction, "enumeration", value=word)


def _literally(word: str) -> str:
    """Escape a word for a pattern."""
    return re.sub(r"([.\\?*+{}()\[\]|^-])", r"\\\1", word)


def _declare_tokens(simple_type: XmlElement, tokens: TokenCount) -> None:
    restriction = xs(simple_type, "restriction")
    if tokens.least == tokens.most == 1:
        restriction.set("base", "xs:string" if tokens.exact else "xs:token")
        xs(restriction, "pattern", value=tokens.pattern)
        return
    items = xs(xs(xs(restriction, "simpleType"), "list"), "simpleType")
    xs(xs(items, "restriction", base="xs:token"), "pattern", value=tokens.pattern)
    if tokens.least == tokens.most:
        xs(restriction, "length", value=str(tokens.least))
    else:
        xs(restriction, "minLength", value=str(tokens.least))
        if tokens.most is not None:
            xs(restriction, "maxLength", value=str(tokens.most))
