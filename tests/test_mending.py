"""A script that has only the answers of `twinform mcp` mends planted mistakes; the report counts all of them."""

from pathlib import Path

import pytest

pytest.importorskip("mcp")

from testbed.mending import PLANTED, Ending, mend_planted

pytestmark = pytest.mark.slow

_EVERY = 8


def test_a_script_mends_mistakes_by_the_answers_alone(tmp_path: Path) -> None:
    mistakes = PLANTED[1::_EVERY]
    endings = mend_planted(tmp_path, mistakes)
    assert set(endings) <= {Ending.SAME, Ending.ANOTHER}
    assert endings.count(Ending.SAME) >= len(mistakes) / 2
