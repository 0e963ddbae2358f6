"""What stands in a file is what counts: edits of converted files, on models that Hypothesis makes up."""

from functools import partial
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from testbed.edits import Edit, apply_all, draw_edits
from testbed.edits.judging import unedited
from testbed.edits.trips import TRIPS, trips
from tests.edits.properties import assert_edits_win
from tests.edits.strategies import copies_of_carriers, edited_files
from tests.profile import examples
from twinform.testing import strategies

_SETTINGS = examples(2)
_FEW = examples(0.4)


@_SETTINGS
@given(edited_files(models=strategies.robots(max_links=4)))
def test_an_edit_of_sdf_that_was_urdf_wins(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
    assert_edits_win(*edited)


@_SETTINGS
@given(edited_files(models=strategies.sdf_models(max_links=4)))
def test_an_edit_of_urdf_that_was_sdf_wins(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
    assert_edits_win(*edited)


@_SETTINGS
@given(edited_files(models=strategies.robots(max_links=4), as_mjcf=True))
def test_an_edit_of_mjcf_that_was_urdf_wins(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
    assert_edits_win(*edited, to="urdf")


@pytest.mark.parametrize("version", ["1.6", "1.8", "1.9"])
def test_an_edit_of_older_sdf_wins(version: str) -> None:
    @_FEW
    @given(edited_files(models=strategies.robots(max_links=3), sdf_version=version))
    def wins(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
        assert_edits_win(*edited)

    wins()


@pytest.mark.parametrize("version", ["1.6", "1.11"])
def test_a_carrier_that_is_copied_anywhere_says_nothing_there(version: str) -> None:
    @_SETTINGS
    @given(edited_files(sdf_version=version, draw=copies_of_carriers))
    def wins(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
        assert_edits_win(*edited)

    wins()


@_FEW
@given(edited_files())
def test_an_edit_that_is_printed_and_read_is_itself(edited: tuple[bytes, tuple[Edit, ...]]) -> None:
    text, edits = edited
    again = [Edit.from_text(str(edit)) for edit in edits]
    assert again == list(edits)
    assert apply_all(again, text) == apply_all(edits, text)


@_FEW
@given(edited_files(), st.randoms(use_true_random=False))
def test_edits_between_trips_win(edited: tuple[bytes, tuple[Edit, ...]], random: Random) -> None:
    made = list(trips(unedited(edited[0]), [partial(draw_edits, random=random)] * TRIPS))
    assert made[-1].verdict.differences == (), "\n".join(str(edit) for trip in made for edit in trip.edits)
