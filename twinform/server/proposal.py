"""A proposal of what to write at the cursor."""

from dataclasses import dataclass

from lsprotocol import types


@dataclass(frozen=True, slots=True)
class Proposal:
    """Something to write: `new` is a snippet, in which `$` stands before places to fill in."""

    label: str
    new: str
    kind: types.CompletionItemKind
    detail: str = ""
    text: str = ""
    first: bool = False
