"""SDF back end: from the IR to the text of an `<sdf>`."""

from twinform.compiler.output.bases_first import with_bases_first
from twinform.diagnostics import Source
from twinform.ir import Document
from twinform.schemas import Version, WrittenParts, root_text


def emit(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """The text of a document in terms of SDF. What was read from SDF keeps its order."""
    arrange = with_bases_first if _has_robots(document) else None
    return root_text("sdf", version, document, namespaces, arrange=arrange, parts=parts)


def _has_robots(document: Document) -> bool:
    """Whether models of a document come from URDF."""
    return any(model.source and _is_of_urdf(model.source) for model in document.models)


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"
