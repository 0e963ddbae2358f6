"""The case files of passes: what a pipeline finds in them, and what it makes of them."""

from pathlib import Path

import pytest

from tests.expected import assert_expected
from twinform.diagnostics import rules
from twinform.testing import PassCase, pass_cases

_CASES = Path(__file__).parent / "cases/passes"
_EDITS = frozenset(
    rule.name
    for rule in (
        rules.ALREADY_HELD,
        rules.EDIT_CONFLICT,
        rules.IRREVERSIBLE_JOINT,
        rules.LINK_NOT_LUMPED,
        rules.LUMPED_AWAY,
        rules.NAME_CLASH,
        rules.NESTED_SETTING,
        rules.NOT_FOR_FORMAT,
        rules.RAISED_VERSION,
        rules.SHAPES_NOT_MOVED,
        rules.UNFOLLOWED_NAME,
        rules.UNKNOWN_NAME,
        rules.UNREAD_DOCUMENT,
    )
)
"""Rules whose notes are all listed too: what is reported of a change of structure is part of what a case shows."""
_EVERY_RUN_COUNTS = {
    "limits/tighten_limits.urdf": "a margin is taken off what is left",
    "structure/attach.sdf": "the second gripper would have the names of the first",
    "structure/attach.urdf": "the second gripper would have the names of the first",
    "structure/lump_as_libsdformat.urdf": "libsdformat puts its prefix and suffix on every name that it sees",
    "structure/rename_follows.sdf": "the old names are gone",
    "structure/rename_follows.urdf": "the old names are gone",
    "structure/rename_shared.urdf": "the old name is gone",
}
"""Cases of passes that do not leave alone what they made, and why that is right."""


def _name(case: PassCase) -> str:
    return str(case.path.relative_to(_CASES))


_ALL = pytest.mark.parametrize("case", pass_cases(_CASES), ids=_name)


@_ALL
def test_passes_find_what_the_case_announces(case: PassCase) -> None:
    assert case.mismatches(in_full=_EDITS) == []


@_ALL
def test_passes_make_what_the_case_shows(case: PassCase) -> None:
    assert_expected(case.changed, case.output_path)


@_ALL
def test_a_second_run_changes_nothing_or_there_is_a_reason(case: PassCase) -> None:
    assert case.settles is (_name(case) not in _EVERY_RUN_COUNTS)
