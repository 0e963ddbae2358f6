"""Writes a document as JSON, and the JSON Schema of such documents."""

import json
import re
from inspect import getdoc
from typing import Any, TypeGuard

from twinform import ir
from twinform.ir import Document, Format, Model, Node, node_values
from twinform.lazy import lazy_pattern
from twinform.schemas import in_order, repeated_fields, table

Data = dict[str, Any]
JsonPath = tuple[str | int, ...]
IDENTIFIER = "urn:twinform:document:1"
"""The name of the schema, with its version: another one where documents of the old one are no longer valid."""

_ROOTS: dict[Format, type[Node]] = {Format.URDF: Model, Format.SDF: Document}
"""The type of node that the root element of a format makes."""
_FIELD = lazy_pattern(r"^    (\w+): (.*(?:\n {5,}.*)*)", re.MULTILINE)
"""A field and its description in the docstring of a class."""
_ORDER = (
    "In which order the parts of several kinds stand in the file: the name of an array for each part. Without it they "
    "stand kind after kind. It changes nothing but the order."
)


def is_object(value: object) -> TypeGuard[Data]:
    """Whether a value is an object of JSON."""
    return isinstance(value, dict)


def is_array(value: object) -> TypeGuard[list[Any]]:
    """Whether a value is an array of JSON."""
    return isinstance(value, list)


def json_text(document: Document) -> str:
    """Return the JSON text of a document."""
    data = {"$schema": IDENTIFIER, **json_data(document)}
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def json_data(document: Document) -> Data:
    """Return a document as JSON data, without the reference to the schema."""
    data: Data = json.loads(document.model_dump_json(exclude_defaults=True))
    _add_spellings_and_order(document, data, document.format)
    if document.format is Format.URDF:
        for model in data.get("models", ()):
            _remove_pose_frames(model)
    return data


def _add_spellings_and_order(node: Node, data: Data, format_: Format) -> None:
    """Add the spellings, and the order of parts of several kinds, which are not fields of the nodes."""
    if node.spelling:
        data["spelling"] = dict(node.spelling)
    order = _order_of_parts(node, format_)
    if order:
        data["order"] = order
    for name, value in node_values(node):
        if isinstance(value, Node):
            _add_spellings_and_order(value, data[name], format_)
        else:
            for child, its in zip(value, data.get(name, ()), strict=True):
                _add_spellings_and_order(child, its, format_)


def _order_of_parts(node: Node, format_: Format) -> list[str]:
    """Return the kinds of a node's parts in the order of the file, or nothing where that is the usual order."""
    facts = table(format_)
    name = facts.root if isinstance(node, _ROOTS[format_]) else type(node).__name__.lower()
    fields = repeated_fields(format_, name)
    items = [(child, field) for field in fields for child in getattr(node, field, ())]
    kinds = [field for _, field in in_order(items)]
    return kinds if kinds != [field for _, field in items] else []


def _remove_pose_frames(model: Data) -> None:
    """Remove the frames of poses: in URDF, a joint is always posed in its parent link, and a link in its joint."""
    for part in (*model.get("joints", ()), *model.get("links", ())):
        pose: Data | None = part.get("pose")
        if pose is not None:
            pose.pop("relative_to", None)
            if not pose:
                del part["pose"]


def json_schema_text() -> str:
    """The JSON Schema of documents: that of Pydantic for the nodes of the IR, and what JSON has beside their fields."""
    schema = Document.model_json_schema()
    schema["properties"]["$schema"] = {"description": "The version of this schema.", "const": IDENTIFIER}
    for name, each in {Document.__name__: schema, **schema["$defs"]}.items():
        if "properties" in each:  # Pydantic before 2.12 describes no dataclass
            each.setdefault("description", getdoc(getattr(ir, name)))
        _describe(each)
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": IDENTIFIER}
    return json.dumps(head | schema, indent=1) + "\n"


def _describe(schema: Data) -> None:
    """Give each field of an object its description, which the docstring of the class has."""
    fields, text = schema.get("properties", {}), schema.get("description", "")
    if "spelling" in fields:  # of a node
        fields["order"] = {"description": _ORDER, "type": "array", "items": {"type": "string"}}
        text = f"{text}\n{getdoc(Node)}"
    for name, meaning in _FIELD.findall(text):
        if name in fields:
            fields[name].pop("title", None)
            fields[name].setdefault("description", " ".join(meaning.split()))
    if "description" in schema:
        schema["description"] = schema["description"].partition("\n\nAttributes:")[0]
