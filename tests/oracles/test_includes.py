"""Worlds with their includes expanded, as the reference parser of SDF sees them."""

from pathlib import Path

import pytest

import twinform
from twinform.testing.oracles import libsdformat

_CASES = Path(__file__).parents[1] / "cases" / "includes"


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("name", ["accept_merged.sdf", "accept_several.sdf", "two_models.sdf"])
def test_libsdformat_accepts_what_includes_become(tmp_path: Path, name: str) -> None:
    result = twinform.convert(_CASES / name, to="sdf", expand_includes=True, paths=[_CASES / "parts"])
    path = tmp_path / name
    path.write_text(result.text)
    assert libsdformat.judge([path])[path].errors == ()
