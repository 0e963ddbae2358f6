"""From a document to JSON, checked against the published schema."""

import json
from typing import Any

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Format, Model, Node, node_values
from twinform.schemas import in_order, repeated_fields, table
from twinform.schemas.json_check import json_faults
from twinform.schemas.json_values import IDENTIFIER as JSON_IDENTIFIER

Data = dict[str, Any]

_ROOTS: dict[Format, type[Node]] = {Format.URDF: Model, Format.SDF: Document}
"""What the root element of a format makes."""


def json_text(document: Document, sink: DiagnosticSink) -> str:
    """The JSON text of a document, and errors in the diagnostics where its format cannot express it."""
    # A document as JSON could say what no file can: two robots in URDF, a robot in a robot, gravity
    # of a link. So it is held against the published schema.
    data = json_data(document)
    for fault in json_faults(data):
        path = "/".join(map(str, fault.path))
        message = f"{path or 'the document'}: {fault.message}; {document.format.upper()} cannot express it"
        sink.report(rules.INVALID_VALUE, message, Location(path=path), found=fault.found, expected=fault.expected)
    return json.dumps({"$schema": JSON_IDENTIFIER, **data}, indent=2, ensure_ascii=False) + "\n"


def json_data(document: Document) -> Data:
    """A document as JSON has it, without the line that names the schema."""
    data: Data = json.loads(document.model_dump_json(exclude_defaults=True))
    _complete(document, data, document.format)
    if document.format is Format.URDF:
        for model in data.get("models", ()):
            _leave_out_places(model)
    return data


def _complete(node: Node, data: Data, format_: Format) -> None:
    """Add what takes no part in equality: spellings, and the order of parts of several kinds."""
    if node.spelling:
        data["spelling"] = dict(node.spelling)
    order = _order(node, format_)
    if order:
        data["order"] = order
    for name, value in node_values(node):
        if isinstance(value, Node):
            _complete(value, data[name], format_)
        else:
            for child, its in zip(value, data.get(name, ()), strict=True):
                _complete(child, its, format_)


def _order(node: Node, format_: Format) -> list[str]:
    """The kinds of a node's parts in the order of the file; nothing where that is the usual one."""
    facts = table(format_)
    name = facts.root if isinstance(node, _ROOTS[format_]) else type(node).__name__.lower()
    fields = repeated_fields(format_, name)
    items = [(child, field) for field in fields for child in getattr(node, field, ())]
    kinds = [field for _, field in in_order(items)]
    return kinds if kinds != [field for _, field in items] else []


def _leave_out_places(model: Data) -> None:
    """In URDF, a joint is posed in its parent link and a link in its joint, so there is no attribute for that."""
    for joint in model.get("joints", ()):
        _leave_out(joint, "relative_to")
    for link in model.get("links", ()):
        _leave_out(link, "relative_to")


def _leave_out(holder: Data, name: str) -> None:
    pose: Data | None = holder.get("pose")
    if pose is not None:
        pose.pop(name, None)
        if not pose:
            del holder["pose"]
