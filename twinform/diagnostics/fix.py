"""`Fix`: how to fix what a finding is about."""

from dataclasses import dataclass
from enum import StrEnum

from twinform.diagnostics.text_edit import TextEdit


class Safety(StrEnum):
    """What a fix may change. Only a safe one is made without being asked for, and one for display never is."""

    SAFE = "safe"
    """The model means the same afterwards: what every reader takes it for is only written down."""
    UNSAFE = "unsafe"
    """The model may mean something else, or the fix is a guess."""
    DISPLAY = "display"
    """An idea: something in it has to be filled in."""


@dataclass(frozen=True, slots=True)
class Fix:
    """Edits of the text that a finding is about, none of which overlaps another; `title` is a command to a person."""

    title: str
    edits: tuple[TextEdit, ...]
    safety: Safety = Safety.SAFE
