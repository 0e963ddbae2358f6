"""Mistakes that are planted into generated models are fixed, and nothing else is changed."""

import random
import re
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from testbed.fixed_files import fixed_file
from testbed.fixed_xacro import as_it_is, fixed_xacro, in_a_macro, in_properties, outline, root_of
from tests.profile import examples
from twinform import Document, dumps
from twinform.compiler import LoadOptions
from twinform.compiler.fixing import FixResult, apply_fixes
from twinform.schemas import XmlElement
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
_IN_VALUES = frozenset({"commas", "capitals", "unit"})
"""Mistakes in values, which xacro leaves as they are."""


@examples()
@given(strategies.robots() | strategies.sdf_models(), _CHANCE, st.sampled_from(sorted(_FIXED_BACK)))
def test_a_mistake_with_one_meaning_is_fixed(document: Document, chance: random.Random, kind: str) -> None:
    text = dumps(document)
    planted = _FIXED_BACK[kind](text, chance)
    rules = {"not-well-formed", "repaired-xml", "invalid-value"}
    made = apply_fixes(planted.encode(), LoadOptions(), rules=rules).data.decode()
    assert made.replace("<!-- a - - b -->", "") == text


@pytest.mark.slow
@examples(0.2)
@given(
    strategies.robots() | strategies.sdf_models(),
    _CHANCE,
    st.sampled_from(sorted(_IN_VALUES)),
    st.sampled_from([as_it_is, in_a_macro, in_properties]),
)
def test_a_fix_in_xacro_expands_to_the_fix_of_what_it_expands_to(
    document: Document, chance: random.Random, kind: str, way: Callable[[XmlElement], dict[str, str]]
) -> None:
    planted = _FIXED_BACK[kind](dumps(document), chance).encode()
    with TemporaryDirectory() as folder:
        made = fixed_xacro(Path(folder), way(root_of(planted)), unsafe=False)
    fixed = apply_fixes(planted, LoadOptions())
    assert [each.rule.name for each in made.applied] != [] or fixed.data == planted or way is in_properties
    if _rules(made) == _rules(fixed):
        assert outline(made.left.content or b"") == outline(fixed.data)


def _rules(fixed: FixResult) -> list[str]:
    return sorted(each.rule.name for each in fixed.applied)


@examples()
@given(
    strategies.robots() | strategies.sdf_models(), _CHANCE, st.lists(st.sampled_from(sorted(_FIXED_BACK)), max_size=4)
)
def test_fixes_keep_their_promises(document: Document, chance: random.Random, kinds: list[str]) -> None:
    text = dumps(document)
    for kind in kinds:
        text = _FIXED_BACK[kind](text, chance)
    assert fixed_file("generated", text.encode()).faults == ()
