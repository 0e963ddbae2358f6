"""Names of topics: what gz-transport takes for one, what Gazebo makes of other text, and patterns with placeholders."""

import re
from collections.abc import Mapping

_REMOVED = re.compile("@|~|//|:=")
_REFUSED = (" ", *_REMOVED.pattern.split("|"))
_LONGEST = 65535
_PLACE = re.compile(r"\{([^{}]++)\}")
"""A placeholder: names of values, of which the first is taken that there is."""
_PIECE = re.compile(r"\(([^()]++)\)")
_EITHER = re.compile(r"\|(?![^{}]*\})")
"""What stands between the texts of a piece, of which the first that can become a topic is taken."""


def is_valid_topic(name: str) -> bool:
    """Whether gz-transport takes a text for a topic (`TopicUtils.cc`, IsValidTopic)."""
    return 0 < len(name.encode()) <= _LONGEST and name != "/" and not any(each in name for each in _REFUSED)


def as_valid_topic(text: str) -> str | None:
    """The topic that Gazebo makes of a text, None where nothing is left of it (`TopicUtils.cc`, AsValidTopic)."""
    name = _REMOVED.sub("", text.replace(" ", "_"))
    return name if is_valid_topic(name) else None


def qualified(name: str) -> str:
    """A valid topic as the bridge and `gz topic` name it (`TopicUtils.cc`, FullyQualifiedName)."""
    return "/" + name.removeprefix("/").removesuffix("/")


def text_of_pattern(pattern: str, values: Mapping[str, str]) -> str | None:
    """A pattern with its values, `{a|b}` with the first of these that there is; None where a value is not there."""
    if not all(_values(found, values) for found in _PLACE.finditer(pattern)):
        return None
    return _PLACE.sub(lambda found: _values(found, values)[0], pattern)


def topic_of_pattern(pattern: str, values: Mapping[str, str], *, raw: bool = False) -> str | None:
    """The topic that a pattern stands for; None where Gazebo has no such topic.

    The text becomes a valid topic, unless it is `raw`: then it has to be one. Where parts of a pattern stand in
    parentheses, only these become valid topics, each by itself, or nothing, and the rest is taken as it is.
    """
    pieces = _PIECE.split(pattern)
    if len(pieces) == 1 and not raw:
        return as_valid_topic(text_of_pattern(pattern, values) or "")
    texts = [
        _topic_of_piece(piece, values) if number % 2 else text_of_pattern(piece, values) or ""
        for number, piece in enumerate(pieces)
    ]
    name = "".join(texts)
    return name if is_valid_topic(name) else None


def _topic_of_piece(piece: str, values: Mapping[str, str]) -> str:
    topics = (as_valid_topic(text_of_pattern(each, values) or "") for each in _EITHER.split(piece))
    return next(filter(None, topics), "")


def placeholders(pattern: str) -> list[str]:
    """The names in the placeholders of a pattern."""
    return [name for found in _PLACE.findall(pattern) for name in found.split("|")]


def without_parentheses(pattern: str) -> str:
    """A pattern as people read it."""
    return _PIECE.sub(lambda piece: _EITHER.split(piece[1])[0], pattern)


def _values(place: re.Match[str], values: Mapping[str, str]) -> list[str]:
    return [values[name] for name in place[1].split("|") if name in values]
