"""Names of topics: what gz-transport takes for one, what Gazebo makes of other text, and patterns with placeholders."""

import re
from collections.abc import Mapping

_REMOVED = re.compile("@|~|//|:=")
_REFUSED = (" ", *_REMOVED.pattern.split("|"))
_LONGEST = 65535
_PLACE = re.compile(r"\{([^{}]++)\}")
"""A placeholder: names of values, of which the first is taken that there is."""
_PIECE = re.compile(r"\(([^()]++)\)")


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
    parentheses, only these become valid topics, each by itself, and the rest is taken as it is.
    """
    texts = [text_of_pattern(piece, values) for piece in _PIECE.split(pattern)]
    if len(texts) > 1:
        texts = [as_valid_topic(text or "") if number % 2 else text for number, text in enumerate(texts)]
    elif not raw:
        texts = [as_valid_topic(text or "") for text in texts]
    name = "".join(filter(None, texts))
    return name if None not in texts and is_valid_topic(name) else None


def placeholders(pattern: str) -> list[str]:
    """The names in the placeholders of a pattern."""
    return [name for found in _PLACE.findall(pattern) for name in found.split("|")]


def without_parentheses(pattern: str) -> str:
    """A pattern as people read it."""
    return _PIECE.sub(r"\1", pattern)


def _values(place: re.Match[str], values: Mapping[str, str]) -> list[str]:
    return [values[name] for name in place[1].split("|") if name in values]
