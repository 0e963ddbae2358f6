"""The text of model files: where each part stands in it, and the smallest edits that change it."""

from twinform.text.alignment import same_element
from twinform.text.editing import Editor
from twinform.text.edits import OverlapError, apply
from twinform.text.masking import masked
from twinform.text.merging import Conflict, Merge, merge
from twinform.text.patching import edits, patch
from twinform.text.positions import AttributeSpan, ElementSpan, Lines, Place, UnplacedError, spans
from twinform.text.source_text import SourceText, UndecodableError
from twinform.text.surroundings import Surroundings

__all__ = [
    "AttributeSpan",
    "Conflict",
    "Editor",
    "ElementSpan",
    "Lines",
    "Merge",
    "OverlapError",
    "Place",
    "SourceText",
    "Surroundings",
    "UndecodableError",
    "UnplacedError",
    "apply",
    "edits",
    "masked",
    "merge",
    "patch",
    "same_element",
    "spans",
]
