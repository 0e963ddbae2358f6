"""IR to SDF."""

from lxml import etree

from twinform.ir import Document
from twinform.schemas import Version, XmlElement, writer


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<sdf>` of a document in terms of SDF."""
    root = etree.Element("sdf", nsmap=namespaces)
    writer("sdf", version).write(document, root)
    return root
