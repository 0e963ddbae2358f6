"""URDF back end: from the IR to a `<robot>`, as a tree or as text."""

from lxml import etree

from twinform.ir import Document
from twinform.schemas import Version, XmlElement, print_version, root_text, writer


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<robot>` of a document in terms of URDF, which has one model."""
    root = etree.Element("robot", nsmap=namespaces)
    writer("urdf", version).write(document.models[0], root)
    if document.version is not None:
        root.set("version", print_version(version))
    return root


def emit_text(document: Document, version: Version, namespaces: dict[str | None, str]) -> str | None:
    """The text of the file with what `emit` makes; nothing where that needs a tree."""
    model = document.models[0]
    if document.version is None:
        return root_text("urdf", version, model, namespaces)
    if any(part.attribute for part in model.opaque):  # which may be a version too
        return None
    attributes = f' version="{print_version(version)}"'
    return root_text("urdf", version, model, namespaces, root_attributes=attributes)
