"""SDF front end: from an `<sdf>` tree to the IR."""

from twinform.ir import Document, Format
from twinform.ir.record import maker
from twinform.schemas import Context, XmlElement, reader

_make_document = maker(Document)


def build(root: XmlElement, context: Context) -> Document | None:
    """The document that an `<sdf>` makes, but for its namespaces; none where it has errors that leave gaps."""
    data = reader("sdf", context.version).read(root, context)
    return None if context.broken else _make_document({"format": Format.SDF, **data})
