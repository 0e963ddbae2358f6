"""Texts follow any change of their trees, with comments, line ends and encodings of any kind in between."""

import random

from hypothesis import given
from hypothesis import strategies as st

from tests.patches import assert_patched
from tests.profile import examples
from twinform import Document, dumps
from twinform.testing import strategies

_ASIDES = ("<!-- a -->", "\n<!--\n  of two lines\n-->\n", "<?an instruction?>", "  ", "\t<!-- \u2603 -->", "\r\n")
_ENCODINGS = ("utf-8", "utf-8-sig", "utf-16")
_CHANCE = st.randoms(use_true_random=False)


@examples()
@given(strategies.robots() | strategies.sdf_models(), st.sampled_from(_ENCODINGS), _CHANCE, st.integers(1, 6))
def test_a_text_follows_its_tree(document: Document, encoding: str, chance: random.Random, times: int) -> None:
    text = _decorated(dumps(document), chance)
    assert_patched(text.encode(encoding), chance, times)


def _decorated(text: str, chance: random.Random) -> str:
    """The text with asides behind some of its tags."""
    text = text.replace('<?xml version="1.0"?>\n', "")
    pieces = [piece + ">" for piece in text.split(">")[:-1]]
    return "".join(piece + (chance.choice(_ASIDES) if chance.random() < 0.2 else "") for piece in pieces)
