"""Comments go along with what they stand at, wherever they stand."""

import random

from hypothesis import given
from hypothesis import strategies as st

from testbed.comments import assert_comments_travel
from tests.profile import examples
from twinform import Document, dumps
from twinform.ir import Format
from twinform.testing import strategies

_CHANCE = st.randoms(use_true_random=False)


@examples(0.5)
@given(strategies.robots() | strategies.sdf_models(), _CHANCE)
def test_comments_travel(document: Document, chance: random.Random) -> None:
    own = "urdf" if document.format is Format.URDF else "sdf"
    assert_comments_travel(_commented(dumps(document), chance).encode(), own)


def _commented(text: str, chance: random.Random) -> str:
    """The text with comments of their own behind some tags, on their lines or below them."""
    pieces = [piece + ">" for piece in text.split(">")[:-1]]
    made: list[str] = []
    for number, piece in enumerate(pieces):
        gap = chance.choice(("", " ", "\n  ", "\n"))
        is_inside = number > 0 and not pieces[min(number + 1, len(pieces) - 1)].strip(" \n").startswith("<!")
        end = chance.choice(("", "\n"))
        made += [piece, f"{gap}<!-- {number} -->{end}" if is_inside and chance.random() < 0.3 else ""]
    return "".join(made)
