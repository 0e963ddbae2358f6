"""Types of parameter values: whether a text is of a type, and the names of types."""

from collections.abc import Callable

from twinform.passes.plugins.catalog_types import PluginParameter
from twinform.schemas import parse_value

# Characters that gz-transport accepts in no topic.
_NOT_IN_TOPICS = ("@", ":=", "//", "~")

_TRUTHS = frozenset({"true", "false", "0", "1"})


def problem_of(row: PluginParameter, text: str) -> str | None:
    """What is wrong with the text of a parameter, as the end of a sentence; None where nothing is."""
    value = text.strip()
    if row.choices and value not in row.choices:
        return f"one of {', '.join(row.choices)}"
    fits, expected = _TYPES.get(row.type, (_is_given, "text"))
    return None if fits(value) else expected


def _is_given(text: str) -> bool:
    return bool(text)


def _is(type_: str) -> Callable[[str], bool]:
    def fits(text: str) -> bool:
        try:
            parse_value(type_, text)
        except ValueError:
            return False
        return True

    return fits


def _has_numbers(*counts: int) -> Callable[[str], bool]:
    is_number = _is("double")

    def fits(text: str) -> bool:
        words = text.split()
        return (len(words) in counts if counts else bool(words)) and all(map(is_number, words))

    return fits


def is_topic(text: str) -> bool:
    """Whether gz-transport takes it for the name of a topic."""
    return bool(text) and not any(map(str.isspace, text)) and not any(part in text for part in _NOT_IN_TOPICS)


def _is_truth(text: str) -> bool:
    return text.lower() in _TRUTHS


_TYPES: dict[str, tuple[Callable[[str], bool], str]] = {
    "number": (_is("double"), "a number"),
    "integer": (_is("int"), "a whole number"),
    "bool": (_is_truth, "true or false"),
    "vector": (_has_numbers(3), "three numbers"),
    "numbers": (_has_numbers(), "numbers"),
    "pose": (_has_numbers(6, 7), "a pose: six numbers"),
    "color": (_has_numbers(3, 4), "a color: three or four numbers"),
    "topic": (is_topic, "a topic, without blanks and `@`, `~`, `:=`, `//`"),
    "joint": (_is_given, "the name of a joint"),
    "link": (_is_given, "the name of a link"),
    "collision": (_is_given, "the name of a collision"),
    "text": (lambda _: True, "text"),
    "element": (lambda _: True, "elements"),
}
