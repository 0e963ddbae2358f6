"""Mistakes as people make them: the line and the columns at which `check` finds those in `mistakes/columns.toml`."""

from pathlib import Path

import pytest

from testbed.mistakes import FOLDER, MISTAKES, Mistake, is_at
from twinform.compiler import check
from twinform.compiler.input.finding_spans import located


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda each: each.what.replace(" ", "-"))
def test_a_mistake_is_found_at_the_piece_that_is_wrong(mistake: Mistake, tmp_path: Path) -> None:
    try:
        path, place = mistake.make(tmp_path)
    except FileNotFoundError as error:
        pytest.skip(str(error))
    found = located(check(path, passes=mistake.passes))
    listed = "\n".join(f"{each.location}: {each.severity} {each.message}" for each in found)
    assert any(is_at(each, place) for each in found) != bool(mistake.missed), f"{place} is not found in\n{listed}"


@pytest.mark.parametrize("name", ["trolley/trolley.urdf.xacro"])
def test_the_files_have_no_mistake_before_the_edit(name: str) -> None:
    assert check(FOLDER / name).diagnostics == ()
