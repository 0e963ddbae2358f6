"""Every regular expression of the package takes a time in proportion to the length of whatever it is given."""

import re
from collections.abc import Callable, Iterable
from typing import Any

import pytest

from tests.patterns.collecting import Used, patterns
from tests.patterns.growth import grows_too_fast
from tests.patterns.hostile_texts import Hostile, hostile_texts
from tests.profile import DEEP

_LENGTH = 2000
"""So long is a text at first; one for which the square of that is nothing passes, and is none that matters."""
_EXCUSED = {
    "server/completion.py": "it is given 500 characters before the cursor",
}
_HELD = [each for each in patterns() if each.place.partition(":")[0] not in _EXCUSED]
_CHOSEN = _HELD if DEEP else _HELD[::16]


def _texts(used: Used) -> Iterable[Hostile]:
    return hostile_texts(used.pattern)[:: 1 if DEEP else 3]


def _ways(pattern: re.Pattern[Any], *, searched: bool) -> Iterable[Callable[[Any], object]]:
    def find_all(text: Any) -> list[object]:
        found: Any = pattern.finditer
        return list(found(text))

    return (pattern.match, find_all) if searched else (pattern.match, pattern.fullmatch)


def _is_slow(used: Used, hostile: Hostile) -> bool:
    def text(length: int) -> str | bytes:
        made = hostile.of_length(length)
        return made if isinstance(used.pattern.pattern, str) else made.encode("latin-1", "replace")

    ways = _ways(used.pattern, searched=used.searched)
    return any(grows_too_fast(lambda length, way=way: way(text(length)), _LENGTH) for way in ways)


@pytest.mark.parametrize("used", _CHOSEN, ids=[each.place for each in _CHOSEN])
def test_a_pattern_takes_linear_time(used: Used) -> None:
    assert next((each for each in _texts(used) if _is_slow(used, each)), None) is None


_GO_BACK = [
    (r"(?:-\S+\s+(?:[-\d.]+\s+)*)*x", False),
    (r"<!--.*?-->", True),
    (r"(?:a+)+", False),
    (r"\d+\.?\d*", False),
    (r"(?:a|a)*", False),
    (r"(\w+)\s*=", True),
    (r"\[@name='(.*?)'\](?=/|$)", True),
    (r"[-+]?(?:\d+\.?\d*|\.\d+)\s*[a-z]", True),
    (r"/(?![^{}]*\})", True),
]


@pytest.mark.parametrize(("pattern", "searched"), _GO_BACK if DEEP else _GO_BACK[:3])
def test_a_pattern_that_goes_back_is_found(pattern: str, searched: bool) -> None:
    """What stood in the package, and what textbooks have: the test above can fail."""
    used = Used("", re.compile(pattern), searched)
    assert any(_is_slow(used, each) for each in hostile_texts(used.pattern))


def test_patterns_of_all_kinds_are_collected() -> None:
    places = {used.place.partition(":")[0] for used in patterns()}
    assert {"text/positions.py", "compiler/fixing/fix_numbers.py", "compiler/input/syntax_places.py"} <= places
    assert {"ir/element.py", "profiles/data", "schemas/xsd"} <= places
    assert sum(used.searched for used in patterns()) > 100
    assert sum(not used.searched for used in patterns()) > 50
