"""The text of model files: where each part stands in it, and the smallest edits that change it."""

from twinform.text.edits import OverlapError, apply
from twinform.text.merging import Conflict, Merge, merge
from twinform.text.patching import edits, patch
from twinform.text.positions import AttributeSpan, ElementSpan, Lines, Place, UnplacedError, spans
from twinform.text.source_text import SourceText, UndecodableError

__all__ = [
    "AttributeSpan",
    "Conflict",
    "ElementSpan",
    "Lines",
    "Merge",
    "OverlapError",
    "Place",
    "SourceText",
    "UndecodableError",
    "UnplacedError",
    "apply",
    "edits",
    "merge",
    "patch",
    "spans",
]
