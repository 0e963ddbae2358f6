"""Masks what is not well-formed and is repaired when a file is read, so that expat can tell where the rest stands.

Each character that is masked becomes a blank: all others keep their offsets.
"""

import re

_ASIDE = re.compile(
    r"(?P<comment><!--.*?-->)|<!\[CDATA\[.*?\]\]>|(?P<declaration><\?xml(?=[\s?]).*?\?>)|<\?.*?\?>", re.DOTALL
)
_LOST_BRACKET = re.compile(r"\s*\?xml\b[^<>]*\?>")
_NOT_LINE_END = re.compile(r"[^\r\n]")


def masked(text: str) -> str:
    """The text without comments and XML declarations."""
    text = _LOST_BRACKET.sub(_blanks, text, count=1) if _LOST_BRACKET.match(text) else text
    return _ASIDE.sub(lambda found: _blanks(found) if found["comment"] or found["declaration"] else found[0], text)


def _blanks(found: re.Match[str]) -> str:
    return _NOT_LINE_END.sub(" ", found[0])
