"""SDF front end: from an `<sdf>` tree to the IR."""

from twinform.ir import Document
from twinform.ir.record import maker
from twinform.schemas import Context, XmlElement

_make_document = maker(Document)


def build(root: XmlElement, context: Context) -> Document | None:
    """The document that an `<sdf>` makes, but for its namespaces; none where it has errors that leave gaps."""
    from twinform.compiler.input.readers.reading import Reading  # noqa: PLC0415 - for files of this format
    from twinform.compiler.input.readers.sdf import read_sdf  # noqa: PLC0415 - for files of this format

    reading = Reading(context)
    data = read_sdf(root, None, "sdf", root.get("name"), reading)
    return None if reading.broken else _make_document(data)
