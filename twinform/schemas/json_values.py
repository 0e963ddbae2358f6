"""The value types of the facts tables in JSON, and what both formats share: texts, numbers, elements."""

from collections.abc import Sequence
from typing import Any

from twinform.schemas.facts import Fact

Json = dict[str, Any]

VERSION = "1"
"""The version of the schema: another one where documents of the old one are no longer valid."""
IDENTIFIER = f"urn:twinform:document:{VERSION}"

_LARGEST = 1.7976931348623157e308
_NOT_IN_XML = r"\u0000-\u0008\u000b\u000c\u000e-\u001f\ud800-\udfff\ufffe\uffff"
_START = (
    "A-Z_a-z\u00c0-\u00d6\u00d8-\u00f6\u00f8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c-\u200d\u2070-\u218f\u2c00-\u2fef"
    "\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
_NAME = rf"[{_START}][{_START}\-.0-9\u00b7\u0300-\u036f\u203f-\u2040]*"
_END = r"$(?!\n)"
"""The end; where a pattern may end before a last line break, as in Python, it does not."""
_INFINITE = ["Infinity", "-Infinity", "NaN"]


def _numbers(least: int, most: int, text: str) -> Json:
    items = {"$ref": "#/$defs/number"}
    return {"description": text, "type": "array", "items": items, "minItems": least, "maxItems": most}


def _object(text: str, fields: Json, required: list[str]) -> Json:
    return {
        "description": text,
        "type": "object",
        "properties": fields,
        "required": required,
        "additionalProperties": False,
    }


def _reference(name: str) -> Json:
    return {"$ref": f"#/$defs/{name}"}


def _pair(text: str, first: str, second: str) -> Json:
    return {
        "description": text,
        "type": "array",
        "prefixItems": [_reference(first), _reference(second)],
        "minItems": 2,
        "maxItems": 2,
    }


_AT = {"description": "The path from the object's own element to the one that holds the part, such as limit.",
       "type": "string", "pattern": rf"^(({_NAME})(/{_NAME})*)?{_END}"}  # fmt: skip
_PARTS: Json = {
    "element": {"description": "An element with all that is in it.", **_reference("element")},
    "attribute": _pair("The name of an attribute and its value.", "name", "text"),
    "text": {"description": "Text between elements.", **_reference("text")},
}

SHARED: dict[str, Json] = {
    "text": {"description": "Any text that XML can hold.", "type": "string", "pattern": f"^[^{_NOT_IN_XML}]*$"},
    "name": {
        "description": "The name of an element or attribute; one in a namespace is written {namespace}name.",
        "type": "string",
        "pattern": rf"^(\{{[^{{}}{_NOT_IN_XML}]+\}})?{_NAME}{_END}",
    },
    "namespace": _pair("A prefix and its namespace; the empty prefix is the default.", "prefix", "uri"),
    "prefix": {"type": "string", "pattern": f"^({_NAME})?{_END}"},
    "uri": {"type": "string", "pattern": rf"^[^{{}}{_NOT_IN_XML}]+{_END}"},
    "number": {"description": "A finite number.", "type": "number", "minimum": -_LARGEST, "maximum": _LARGEST},
    "number-or-infinite": {
        "description": "A number; JSON has none that is infinite or undefined, so these are text.",
        "anyOf": [_reference("number"), {"enum": _INFINITE}],
    },
    "vector2": _numbers(2, 2, "x and y."),
    "vector3": _numbers(3, 3, "x, y and z."),
    "quaternion": _numbers(4, 4, "x, y, z and w."),
    "color": _numbers(3, 4, "Red, green, blue and perhaps alpha, each from 0 to 1."),
    "color4": _numbers(4, 4, "Red, green, blue and alpha, each from 0 to 1."),
    "element": _object(
        "An element that has no typed form.",
        {
            "name": {"description": "The name of the element.", **_reference("name")},
            "attributes": {
                "description": "Its attributes in order.",
                "type": "array",
                "items": _pair("A name and a value.", "name", "text"),
            },
            "text": {"description": "The text before its first child.", **_reference("text")},
            "children": {"description": "The elements in it.", "type": "array", "items": _reference("element")},
            "tail": {"description": "The text that follows its end.", **_reference("text")},
        },
        ["name"],
    ),
    "opaque": {
        "description": "A part without a field: an element, an attribute or text.",
        "oneOf": [
            _object(f"{name.capitalize()} without a field.", {"at": _AT, name: schema}, [name])
            for name, schema in _PARTS.items()
        ],
    },
}
"""Definitions that both formats refer to."""

_TYPES: dict[str, Json] = {
    "string": _reference("text"),
    "bool": {"type": "boolean"},
    "int": {"type": "integer"},
    "uint": {"type": "integer", "minimum": 0},
    "vector2d": _reference("vector2"),
    "vector3": _reference("vector3"),
    "quaternion": _reference("quaternion"),
    "color": _reference("color"),
    "color4": _reference("color4"),
}


def value_schema(format: str, rows: Sequence[Fact]) -> Json:
    """The schema of a value: that of all rows of one name, whose values it has together."""
    words = [word for row in rows for word in (*row.enum, *(other for other, _ in row.also))]
    if words:
        return {"enum": list(dict.fromkeys(words))}
    kind = rows[-1].type or "string"
    if kind == "double":
        return _reference("number" if format == "urdf" else "number-or-infinite")
    return _TYPES[kind]
