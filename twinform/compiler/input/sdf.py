"""SDF front end: from an `<sdf>` tree to the data of the IR."""

from collections.abc import Mapping
from typing import Any

from twinform.schemas import Context, XmlElement, reader


def lower(root: XmlElement, context: Context) -> Mapping[str, Any]:
    """The data of the document that an `<sdf>` makes."""
    return {"format": "sdf", **reader("sdf", context.version).read(root, context)}
