"""URDF back end: from the IR to the text of a `<robot>`."""

from twinform.ir import Document, Opaque
from twinform.schemas import Version, WrittenParts, print_version, root_text


def emit(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """The text of a document in terms of URDF, which has one model."""
    model = document.models[0]
    if document.version is not None:  # as an untyped attribute it is behind the others, and instead of another version
        attribute = Opaque.unchecked(attribute=("version", print_version(version)))
        model = model.copy(opaque=(*model.opaque, attribute))
    return root_text("urdf", version, model, namespaces, parts=parts)
