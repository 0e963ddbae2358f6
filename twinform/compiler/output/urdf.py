"""URDF back end: from the IR to a `<robot>` tree."""

from lxml import etree

from twinform.ir import Document
from twinform.schemas import Version, XmlElement, print_version, writer


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<robot>` of a document in terms of URDF, which has one model."""
    root = etree.Element("robot", nsmap=namespaces)
    writer("urdf", version).write(document.models[0], root)
    if document.version is not None:
        root.set("version", print_version(version))
    return root
