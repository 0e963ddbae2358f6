"""Inertias that no body has, in bodies of fixed links: what SDF makes of them, and what comes back."""

from pathlib import Path

import pytest

import twinform
from tests.corpus.files import ROOT
from twinform.ir import Document
from twinform.ir.solids import tensor
from twinform.testing.oracles import libsdformat

_CASE = ROOT / "tests/cases/convert/impossible_part.urdf"
_OLD = 'ixx="1e-06" ixy="1e-06" ixz="1e-06" iyy="1e-06" iyz="1e-06" izz="1e-06"'


def _sdf(*, carriers: bool = True) -> str:
    return twinform.convert(_CASE, to="sdf", sdf_version="1.9", carriers=carriers).text


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("carriers", [True, False])
def test_libsdformat_takes_it_as_it_takes_the_urdf(carriers: bool, tmp_path: Path) -> None:
    made = tmp_path / "made.sdf"
    made.write_text(_sdf(carriers=carriers))
    assert libsdformat.judge([_CASE])[_CASE].ok
    assert libsdformat.judge([made])[made].ok


def test_the_body_has_the_inertia_that_it_had() -> None:
    before = twinform.convert(_CASE, to="urdf", passes="lump-fixed-joints").document
    after = twinform.convert(_sdf(carriers=False).encode(), to="sdf", passes="lump-fixed-joints").document
    assert _inertia(after) == pytest.approx(_inertia(before), abs=1e-14)


def _inertia(document: Document) -> list[float]:
    inertial = document.models[0].links[0].inertial
    assert inertial is not None
    return [inertial.mass or 0.0, *tensor(inertial.inertia)]


def test_it_comes_back_as_it_was() -> None:
    made = twinform.convert(_sdf().encode(), to="urdf")
    assert _OLD in made.text
    assert 'ixx="0.2" ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.4"' in made.text
    assert not [each for each in made.diagnostics if each.rule.name == "stale-carrier"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("0.1 0 0 0 0.5 0.2", "0.1 0 0 0 0.9 0.2"),  # which turns the one link in the other
        ('<joint name="fix" type="fixed">', '<joint name="fix" type="ball">'),
        ("<iyy>1.333", "<iyy>1.4"),
        ("<iyy>0.29999", "<iyy>0.25"),
    ],
)
def test_it_stays_where_the_body_was_edited(old: str, new: str) -> None:
    sdf = _sdf()
    assert old in sdf
    made = twinform.convert(sdf.replace(old, new).encode(), to="urdf")
    assert _OLD not in made.text
    assert "tf:shared" not in made.text
    assert "stale-carrier" in {each.rule.name for each in made.diagnostics}
