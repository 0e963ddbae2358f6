"""SDF back end: from the IR to an `<sdf>`, as a tree or as text."""

from lxml import etree

from twinform.compiler.output.bases_first import has_untyped_names, parts_with_bases_first, put_bases_first
from twinform.diagnostics import Source
from twinform.ir import Document
from twinform.schemas import Version, XmlElement, root_text, writer

_MODEL = frozenset({"model"})
"""Elements in which frames have an order. Untyped ones, such as a model in a population, are put in order as trees."""


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<sdf>` of a document in terms of SDF. What was read from SDF keeps its order."""
    root = etree.Element("sdf", nsmap=namespaces)
    writer("sdf", version).write(document, root)
    if _has_robots(document):
        for model in root.iter("model"):
            put_bases_first(model)
    return root


def emit_text(document: Document, version: Version, namespaces: dict[str | None, str]) -> str | None:
    """The text of the file with what `emit` makes; nothing where that needs a tree."""
    if not _has_robots(document):
        return root_text("sdf", version, document, namespaces)
    if any(map(has_untyped_names, document.models)):
        return None
    return root_text("sdf", version, document, namespaces, arrange=parts_with_bases_first, refused=_MODEL)


def _has_robots(document: Document) -> bool:
    """Whether models of a document come from URDF."""
    return any(model.source and _is_of_urdf(model.source) for model in document.models)


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"
