"""Proposals of completion, the places that they are for, and their form in the protocol."""

import re
from collections.abc import Iterable
from typing import NamedTuple

from lsprotocol import types

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.server.documents import TextDocument
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

ITEM = types.CompletionItemKind
_HOLE = lazy_pattern(r"(?P<escaped>\\\$)|\$\{[^}$]*\}|\$.?", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Proposal:
    """Something to write: `new` is a snippet, in which `$` marks places to fill in.

    Rank 0 is for required parts, which come first; rank 2 is for what is seldom meant, which comes last.
    """

    label: str
    new: str
    kind: types.CompletionItemKind
    detail: str = ""
    text: str = ""
    rank: int = 1


class ValuePlace(NamedTuple):
    """The place of a value: an attribute of an element or, without one, the text in it.

    `typed` is what stands before the cursor.
    """

    session: Session
    document: TextDocument
    node: TolerantNode
    attribute: str | None
    typed: str


class ElementPlace(NamedTuple):
    """A place for an element in another: `own` is the one that is being typed; `bare` asks for the names only."""

    session: Session
    document: TextDocument
    parent: TolerantNode
    own: TolerantNode | None
    bare: bool

    @property
    def siblings(self) -> list[str]:
        """The tags of the other elements there."""
        return [child.tag for child in self.parent.children if child is not self.own]


def element_snippet(tag: str, attributes: Iterable[str], *, holds: bool) -> str:
    """Return the snippet of an element with attributes to fill in, and with room in it where it `holds` others."""
    filled = "".join(f' {name}="${number}"' for number, name in enumerate(attributes, 1))
    return f"{tag}{filled}>\n  $0\n</{tag}>" if holds else f"{tag}{filled}/>$0"


def literal(text: str) -> str:
    """Escape a text for a snippet, in which `$CLIPBOARD` is what was copied last."""
    return text.replace("\\", "").replace("$", "\\$")


def plain(snippet: str) -> str:
    """Remove the places to fill in from a snippet."""
    return _HOLE.sub(lambda found: "$" if found["escaped"] else "", snippet)


def values(
    found: Iterable[str], kind: types.CompletionItemKind = ITEM.EnumMember, detail: str = ""
) -> Iterable[Proposal]:
    """Propose texts as they stand."""
    return (Proposal(each, literal(each), kind, detail) for each in found)


def completion_list(
    session: Session, document: TextDocument, span: Span, found: Iterable[Proposal]
) -> types.CompletionList:
    """Return proposals as an editor takes them, each label once; each replaces a piece of the document."""
    range_ = document.positions.range(span)
    format_ = types.InsertTextFormat.Snippet if session.snippets else types.InsertTextFormat.PlainText
    once = {each.label: each for each in reversed(list(found))}
    items = [
        types.CompletionItem(
            label=each.label,
            kind=each.kind,
            detail=each.detail or None,
            documentation=types.MarkupContent(types.MarkupKind.Markdown, each.text) if each.text else None,
            sort_text=f"{each.rank}{number:04}",
            filter_text=each.label,
            insert_text_format=format_,
            text_edit=types.TextEdit(range_, each.new if session.snippets else plain(each.new)),
        )
        for number, each in enumerate(reversed(once.values()))
    ]
    return types.CompletionList(is_incomplete=False, items=items)
