"""Topic names: what gz-transport accepts, what Gazebo makes of other texts, and patterns with placeholders."""

import re
from collections.abc import Mapping

from twinform.lazy import lazy_pattern

_REMOVED = lazy_pattern("@|~|//|:=")
_REFUSED = (" ", *_REMOVED.pattern.split("|"))
_LONGEST = 65535
_PLACE = lazy_pattern(r"\{([^{}]++)\}")
"""A placeholder: names of values, of which the first that is known is taken."""
_PIECE = lazy_pattern(r"\(([^()]++)\)")
_CHOICE = lazy_pattern(r"\|(?![^{}]*\})")
"""Separates the texts of a piece, of which the first that can become a topic is taken."""


def is_valid_topic(name: str) -> bool:
    """Whether gz-transport accepts a text as a topic (`TopicUtils.cc`, IsValidTopic)."""
    return 0 < len(name.encode()) <= _LONGEST and name != "/" and not any(each in name for each in _REFUSED)


def as_valid_topic(text: str) -> str | None:
    """The topic that Gazebo makes of a text; None if nothing is left of it (`TopicUtils.cc`, AsValidTopic)."""
    name = _REMOVED.sub("", text.replace(" ", "_"))
    return name if is_valid_topic(name) else None


def qualified(name: str) -> str:
    """A valid topic as the bridge and `gz topic` name it (`TopicUtils.cc`, FullyQualifiedName)."""
    return "/" + name.removeprefix("/").removesuffix("/")


def fill_pattern(pattern: str, values: Mapping[str, str]) -> str | None:
    """A pattern with its values, `{a|b}` with the first of these that is known; None if a value is unknown."""
    if not all(_available_values(found, values) for found in _PLACE.finditer(pattern)):
        return None
    return _PLACE.sub(lambda found: _available_values(found, values)[0], pattern)


def fill_topic_pattern(pattern: str, values: Mapping[str, str], *, raw: bool = False) -> str | None:
    """The topic that a pattern stands for; None if Gazebo has no such topic.

    The text becomes a valid topic, except where `raw`: then it has to be one. If parts of a pattern are in parentheses,
    only these become valid topics, each by itself, or nothing, and the rest stays as it is.
    """
    pieces = _PIECE.split(pattern)
    if len(pieces) == 1 and not raw:
        return as_valid_topic(fill_pattern(pattern, values) or "")
    texts = [
        _fill_piece(piece, values) if number % 2 else fill_pattern(piece, values) or ""
        for number, piece in enumerate(pieces)
    ]
    name = "".join(texts)
    return name if is_valid_topic(name) else None


def _fill_piece(piece: str, values: Mapping[str, str]) -> str:
    topics = (as_valid_topic(fill_pattern(each, values) or "") for each in _CHOICE.split(piece))
    return next(filter(None, topics), "")


def placeholders(pattern: str) -> list[str]:
    """The names in the placeholders of a pattern."""
    return [name for found in _PLACE.findall(pattern) for name in found.split("|")]


def without_parentheses(pattern: str) -> str:
    """A pattern for people to read."""
    return _PIECE.sub(lambda piece: _CHOICE.split(piece[1])[0], pattern)


def _available_values(place: re.Match[str], values: Mapping[str, str]) -> list[str]:
    return [values[name] for name in place[1].split("|") if name in values]
