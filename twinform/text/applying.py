"""Applies edits to a text: pieces of it are replaced by others."""

from collections.abc import Iterable

from twinform.diagnostics import TextEdit


class OverlapError(ValueError):
    """Two edits want to change the same piece."""


def apply(text: str, edits: Iterable[TextEdit]) -> str:
    """The text after all edits; those at one place are made in the order in which they are given.

    Raises:
        OverlapError: two of them overlap.
    """
    pieces: list[str] = []
    here = 0
    for span, new in sorted(edits, key=lambda edit: edit.span):
        if span.start < here:
            raise OverlapError(f"two edits overlap at offset {span.start}")
        pieces += (text[here : span.start], new)
        here = span.end
    return "".join((*pieces, text[here:]))
