"""`<gazebo>` elements that nothing is left of."""

from twinform.ir import Document, GazeboExtension, Model


def without_emptied(before: Document, after: Document) -> Document:
    """The document without the `<gazebo>` elements from which everything has gone; empty ones of the source stay."""
    if before is after:
        return after
    models = tuple(_in_model(old, new) for old, new in zip(before.models, after.models, strict=True))
    same = all(new is old for new, old in zip(models, after.models, strict=True))
    return after if same else after.model_copy(update={"models": models})


def _in_model(before: Model, after: Model) -> Model:
    pairs = zip(before.extensions, after.extensions, strict=True)
    kept = tuple(new for old, new in pairs if not _is_emptied(old, new))
    return after if len(kept) == len(after.extensions) else after.model_copy(update={"extensions": kept})


def _is_emptied(before: GazeboExtension, after: GazeboExtension) -> bool:
    return bool(before.content) and not after.content and not after.opaque
