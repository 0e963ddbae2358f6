"""Readers of attribute values and texts: parsed, checked, and stored in the field of the IR."""

from collections.abc import Callable, Mapping

from twinform.schemas import messages
from twinform.schemas.facts import Fact, Version
from twinform.schemas.messages import Context
from twinform.schemas.untyped_parts import keep_part
from twinform.schemas.value_stores import Data, value_check, value_store
from twinform.schemas.values import ValueType
from twinform.schemas.xml import XmlElement, is_blank

Types = Mapping[str, ValueType]
"""The value types of a format by their names."""
ReadAttribute = Callable[[XmlElement, str, Data, str, Context], None]
"""Reads an attribute: (element, text, node, path from the node, context)"""
ReadText = Callable[[XmlElement, Data, str, Context], bool]
"""Reads the text of an element: (element, node, path from the node, context); it returns whether there was any"""


def attribute_reader(row: Fact, types: Types, version: Version, *, keep: bool) -> ReadAttribute:
    """The reader of an attribute: checked, and stored in its field or kept as it is where `keep` asks for it."""
    value_type = types[row.type or "string"]
    parse, check = value_type.parse, value_check(row)
    late, name, dialect = not row.exists_in(version), row.name[1:], row.dialect
    store = value_store(row, row.place) if keep and row.place else None

    def read(element: XmlElement, text: str, node: Data, at: str, context: Context) -> None:
        if late:
            messages.outside_version(context, element, row)
        if dialect:
            messages.dialect_attribute(context, element, name, dialect)
        try:
            value = parse(text)
        except ValueError:
            messages.invalid_value(context, element, row.name, text, value_type.expected)
            return
        if check is not None:
            check(element, value, context)
        if store is not None:
            store(element, node, (value, text), context)
        elif keep:
            keep_part(element, node, context, {"at": at, "attribute": (name, text)})

    return read


def text_reader(row: Fact, types: Types, place: str | None, *, keep: bool) -> ReadText:
    """The reader of an element's text; it returns whether there was any. Blank text means the default."""
    value_type = types[row.type or "string"]
    parse, check, is_string, needed = value_type.parse, value_check(row), row.type == "string", row.needs_text
    store = value_store(row, place) if keep and place else None
    is_pose, expected = row.type == "pose", needed or bool(row.default)

    def read(element: XmlElement, node: Data, at: str, context: Context) -> bool:
        text = element.text or ""
        if is_string:
            text = text.strip(" \t\r\n")
            # an empty parameter of URDF is a value like others
            if expected and not text and context.format == "sdf":
                messages.blank_value(context, element, value_type.expected)
        elif is_blank(text):
            if needed:
                messages.missing_text(context, element, value_type.expected)
            elif not is_pose:
                messages.blank_value(context, element, value_type.expected)
            return False
        try:
            value = parse(text)
        except ValueError:
            messages.invalid_value(context, element, "", text.strip(), value_type.expected)
            return True
        if check is not None:
            check(element, value, context)
        if store is not None:
            store(element, node, (value, text), context)
        return True

    return read
