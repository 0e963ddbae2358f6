"""The text of model files: where each part stands in it, and the smallest edits that change it."""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.text.alignment import same_element
    from twinform.text.applying import OverlapError, apply
    from twinform.text.element_edits import Editor
    from twinform.text.masking import masked
    from twinform.text.merging import Conflict, Merge, merge
    from twinform.text.patching import edits, patch
    from twinform.text.positions import AttributeSpan, ElementSpan, LineColumn, Lines, UnplacedError, spans
    from twinform.text.source_text import SourceText, UndecodableError
    from twinform.text.surroundings import TextSurroundings
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.text.alignment": "same_element",
            "twinform.text.applying": "OverlapError apply",
            "twinform.text.element_edits": "Editor",
            "twinform.text.masking": "masked",
            "twinform.text.merging": "Conflict Merge merge",
            "twinform.text.patching": "edits patch",
            "twinform.text.positions": "AttributeSpan ElementSpan LineColumn Lines UnplacedError spans",
            "twinform.text.source_text": "SourceText UndecodableError",
            "twinform.text.surroundings": "TextSurroundings",
        },
    )

__all__ = [
    "AttributeSpan",
    "Conflict",
    "Editor",
    "ElementSpan",
    "LineColumn",
    "Lines",
    "Merge",
    "OverlapError",
    "SourceText",
    "TextSurroundings",
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
