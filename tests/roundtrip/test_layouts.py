"""The formatter keeps what a text means, whatever its layout was."""

import random

from hypothesis import given
from hypothesis import strategies as st

from tests.layouts import assert_formatted, scattered
from tests.profile import examples
from twinform import Document, dumps
from twinform.testing import strategies

_ENCODINGS = ("utf-8", "utf-8-sig", "utf-16")
_CHANCE = st.randoms(use_true_random=False)


@examples()
@given(strategies.robots() | strategies.sdf_models(), st.sampled_from(_ENCODINGS), _CHANCE)
def test_any_layout_is_formatted(document: Document, encoding: str, chance: random.Random) -> None:
    assert_formatted(scattered(dumps(document), chance).encode(encoding), is_model=True)
