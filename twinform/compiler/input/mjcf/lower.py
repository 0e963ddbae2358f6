"""From canonical MJCF to a document in the terms of SDF."""

from twinform.diagnostics import Source
from twinform.ir import Document, Format, Link, Model
from twinform.schemas import DEFAULT_SDF_VERSION, Context, XmlElement


def lower(root: XmlElement, context: Context) -> Document:
    """Build the document of a canonical tree."""
    source = Source(context.file, root.sourceline or 0, None, "mujoco", None)
    links = [
        Link.unchecked(
            name=body.get("name") or f"body_{place}",
            source=Source(context.file, body.sourceline or 0, source, "body", body.get("name")),
        )
        for place, body in enumerate(root.iter("body"), 1)
    ]
    model = Model.unchecked(name=root.get("model") or "model", links=tuple(links), source=source)
    return Document.unchecked(format=Format.SDF, version=DEFAULT_SDF_VERSION, models=(model,), source=source)
