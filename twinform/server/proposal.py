"""A proposal of what to write at the cursor."""

from dataclasses import dataclass

from lsprotocol import types


def literal(text: str) -> str:
    """A text in a snippet, where `$` has a meaning: `$CLIPBOARD` is what somebody has copied last."""
    return text.replace("\\", "").replace("$", "\\$")


@dataclass(frozen=True, slots=True)
class Proposal:
    """Something to write: `new` is a snippet, in which `$` stands before places to fill in.

    Those of rank 0 come first: what is needed. Those of rank 2, which only some readers know, come last.
    """

    label: str
    new: str
    kind: types.CompletionItemKind
    detail: str = ""
    text: str = ""
    rank: int = 1
