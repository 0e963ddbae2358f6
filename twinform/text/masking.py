"""Masks what other parsers let pass in a text, so that the places of all else are known: comments, XML declarations."""

import re

from twinform.text.asides import COMMENT, IN_COMMENT, IN_INSTRUCTION, INSTRUCTION, SECTION

_ASIDE = re.compile(
    rf"{SECTION}|<!--(?P<comment>{IN_COMMENT})-->|{COMMENT}|(?P<declaration><\?xml\s{IN_INSTRUCTION}\?>)"
    rf"|{INSTRUCTION}",
    re.IGNORECASE,
)
_VISIBLE = re.compile(r"[^\r\n]")


def masked(text: str) -> str:
    """A text of the same length and lines, with blanks for declarations and for what stands in comments."""
    return _ASIDE.sub(_blank, text)


def _blank(found: re.Match[str]) -> str:
    if found["declaration"]:
        return _VISIBLE.sub(" ", found[0])
    if found["comment"] is None:
        return found[0]
    return f"<!--{_VISIBLE.sub(' ', found['comment'])}-->"
