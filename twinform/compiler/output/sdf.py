"""IR to SDF."""

from lxml import etree

from twinform.compiler.output.frame_order import put_bases_first
from twinform.diagnostics import Source
from twinform.ir import Document
from twinform.schemas import Version, XmlElement, writer


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<sdf>` of a document in terms of SDF. What was read from SDF keeps its order."""
    root = etree.Element("sdf", nsmap=namespaces)
    writer("sdf", version).write(document, root)
    if any(model.source and _is_of_urdf(model.source) for model in document.models):
        for model in root.iter("model"):
            put_bases_first(model)
    return root


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"
