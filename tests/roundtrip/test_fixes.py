"""Mistakes that are planted into generated models are fixed, and nothing else is changed."""

import random
import re
from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st

from testbed.fixed_files import fixed_file
from tests.profile import examples
from twinform import Document, dumps
from twinform.compiler import LoadOptions
from twinform.compiler.fixing import apply_fixes
from twinform.testing import strategies

_CHANCE = st.randoms(use_true_random=False)
_Plant = Callable[[str, random.Random], str]


def _one(pattern: str, new: str) -> _Plant:
    """Change one of the places where a pattern is found."""

    def plant(text: str, chance: random.Random) -> str:
        places = [*re.finditer(pattern, text)]
        if not places:
            return text
        place = chance.choice(places)
        return text[: place.start()] + place.expand(new) + text[place.end() :]

    return plant


_FIXED_BACK: dict[str, _Plant] = {
    "hyphens": lambda text, _: text.replace("<robot", "<!-- a -- b --><robot", 1).replace(
        "<sdf", "<!-- a -- b --><sdf", 1
    ),
    "commas": _one(r'(xyz="\S+) (\S+) (\S+")', r"\1, \2, \3"),
    "capitals": _one(r'type="(fixed)"', r'type="FIXED"'),
    "no quotes": _one(r' type="(\w+)"', r" type=\1"),
    "unit": _one(r'radius="([-\d.e]+)"', r'radius="\1 m"'),
    "late declaration": lambda text, _: "\n" + text,
    "no blank": _one(r'(" )(\w+=")', r'"\2'),
}
"""Mistakes of which the fix is certain: the text is as it was, but for what is said below."""


@examples()
@given(strategies.robots() | strategies.sdf_models(), _CHANCE, st.sampled_from(sorted(_FIXED_BACK)))
def test_a_mistake_with_one_meaning_is_fixed(document: Document, chance: random.Random, kind: str) -> None:
    text = dumps(document)
    planted = _FIXED_BACK[kind](text, chance)
    rules = {"not-well-formed", "repaired-xml", "invalid-value"}
    made = apply_fixes(planted.encode(), LoadOptions(), rules=rules).data.decode()
    assert made.replace("<!-- a - - b -->", "") == text


@examples()
@given(
    strategies.robots() | strategies.sdf_models(), _CHANCE, st.lists(st.sampled_from(sorted(_FIXED_BACK)), max_size=4)
)
def test_fixes_keep_their_promises(document: Document, chance: random.Random, kinds: list[str]) -> None:
    text = dumps(document)
    for kind in kinds:
        text = _FIXED_BACK[kind](text, chance)
    assert fixed_file("generated", text.encode()).faults == ()
