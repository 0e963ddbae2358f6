"""Provenance annotation: the format and version that a model was converted from, read by the reverse conversion.

<tf:from format="sdf" version="1.9"/>
<tf:from format="sdf" version="1.6" mixed="true"/>      whose file uses syntax that 1.6 does not have
"""

from twinform.ir import Document, Format, Model
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.schemas import parse_version, versions_of

_SCOPES = (1, 8)
"""Since this version `::` in a name means that it is in a nested model."""
FROM = "from"
"""The annotation on a model with the format and the version that it was converted from."""
_MIXED = "mixed"


def with_provenance(model: Model, document: Document) -> Model:
    """The model, annotated as converted from the format and version of a document."""
    attributes = {"format": document.format.value, "version": document.version or "1.0"}
    mixed = "true" if find_annotation(model, _MIXED) is not None else None
    return with_annotation(without_annotation(model, _MIXED), FROM, attributes={**attributes, "mixed": mixed})


def with_mixed_words(model: Model) -> Model:
    """The model, annotated as one whose file uses syntax that its version does not have."""
    return with_annotation(model, _MIXED)


def without_provenance(model: Model) -> Model:
    """The model without the annotation."""
    return without_annotation(model, FROM)


def came_from(model: Model, format_: Format) -> bool:
    """Whether a model was converted from a format."""
    found = find_annotation(model, FROM)
    return found is not None and found.get("format") == format_.value


def wrote_scopes(model: Model) -> bool:
    """Whether a model was converted from SDF before 1.8, where `::` may stand in any name."""
    found = find_annotation(model, FROM)
    return came_from(model, Format.SDF) and may_write_scopes((found and found.get("version")) or "")


def may_write_scopes(version: str) -> bool:
    """Whether `::` may stand in any name in a version of SDF; in one that does not exist it may not."""
    return version in versions_of("sdf") and parse_version(version) < _SCOPES


def has_mixed_words(document: Document) -> bool:
    """Whether the file that the only model of a document was converted from has syntax of other versions too."""
    found = find_annotation(document.models[0], FROM) if len(document.models) == 1 else None
    return found is not None and found.get("mixed") == "true"


def source_version(document: Document, format_: Format) -> str | None:
    """The version of a format that the only model of a document was converted from; None where it was not."""
    if len(document.models) != 1 or not came_from(document.models[0], format_):
        return None
    found = find_annotation(document.models[0], FROM)
    return found.get("version") if found else None
