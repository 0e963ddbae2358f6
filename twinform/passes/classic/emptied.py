"""`<gazebo>` elements that nothing is left of."""

from twinform.ir import Document, GazeboExtension, Model, replace_fields


def without_emptied(before: Document, after: Document) -> Document:
    """The document without the `<gazebo>` elements from which everything has gone; empty ones of the source stay."""
    if before is after:
        return after
    return replace_fields(after, models=tuple(map(_in_model, before.models, after.models)))


def _in_model(before: Model, after: Model) -> Model:
    pairs = zip(before.extensions, after.extensions, strict=True)
    return replace_fields(after, extensions=tuple(new for old, new in pairs if not _is_emptied(old, new)))


def _is_emptied(before: GazeboExtension, after: GazeboExtension) -> bool:
    return bool(before.content) and not after.content and not after.opaque
