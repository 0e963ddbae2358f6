"""The text of model files: where each part stands in it, and the smallest edits that change it."""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.text.alignment import same_element
    from twinform.text.merging import Conflict, Merge, merge
    from twinform.text.patching import Editor, edits, patch
    from twinform.text.positions import AttributeSpan, ElementSpan, LineColumn, Lines, spans
    from twinform.text.serializing import TextSurroundings
    from twinform.text.source_text import OverlapError, SourceText, UndecodableError, apply
    from twinform.text.tokens import UnplacedError, masked
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.text.alignment": "same_element",
            "twinform.text.source_text": "OverlapError apply SourceText UndecodableError",
            "twinform.text.patching": "Editor edits patch",
            "twinform.text.tokens": "UnplacedError masked",
            "twinform.text.merging": "Conflict Merge merge",
            "twinform.text.positions": "AttributeSpan ElementSpan LineColumn Lines spans",
            "twinform.text.serializing": "TextSurroundings",
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
