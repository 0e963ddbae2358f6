"""Inertias that no body has, in bodies of fixed links: what SDF makes of them, and what comes back."""

from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import ROOT
from twinform.ir import Document, Inertial
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import tensor
from twinform.ir.transform import Transform
from twinform.passes.shared.link_shapes import body_of
from twinform.testing.oracles import libsdformat

_CASE = ROOT / "tests/cases/convert/impossible_part.urdf"
_HANDS = _CASE.with_name("impossible_parts_apart.urdf")
_OLD = 'ixx="1e-06" ixy="1e-06" ixz="1e-06" iyy="1e-06" iyz="1e-06" izz="1e-06"'


def _sdf(case: Path = _CASE, *, carriers: bool = True) -> str:
    return twinform.convert(case, to="sdf", sdf_version="1.9", carriers=carriers).text


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("case", [_CASE, _HANDS], ids=lambda case: case.stem)
@pytest.mark.parametrize("carriers", [True, False])
def test_libsdformat_takes_it_as_it_takes_the_urdf(case: Path, carriers: bool, tmp_path: Path) -> None:
    made = tmp_path / "made.sdf"
    made.write_text(_sdf(case, carriers=carriers))
    assert libsdformat.judge([case])[case].ok
    assert libsdformat.judge([made])[made].ok


@pytest.mark.parametrize("case", [_CASE, _HANDS], ids=lambda case: case.stem)
def test_the_body_has_the_mass_center_and_inertia_that_it_had(case: Path) -> None:
    before = twinform.convert(case, to="urdf", passes="lump-fixed-joints").document
    after = twinform.convert(_sdf(case, carriers=False).encode(), to="sdf", passes="lump-fixed-joints").document
    assert _body(after) == pytest.approx(_body(before), abs=1e-14)


def _body(document: Document) -> list[float]:
    model = document.models[0]
    body = body_of(model.links[0], FrameGraph(model), document.format)
    return [body.mass, *body.center, *body.inertia]


@pytest.mark.parametrize("case", [_CASE, _HANDS], ids=lambda case: case.stem)
def test_it_comes_back_as_it_was(case: Path) -> None:
    made = twinform.convert(_sdf(case).encode(), to="urdf")
    assert _written(made.document) == _written(twinform.load(case))
    assert not [each for each in made.diagnostics if each.rule.name == "stale-carrier"]


def _written(document: Document) -> dict[str, tuple[object, ...]]:
    inertials = {link.name: link.inertial or Inertial() for link in document.models[0].links}
    return {name: (each.mass, tensor(each.inertia), Transform.from_pose(each.pose)) for name, each in inertials.items()}


@pytest.mark.parametrize(("old", "new"), [("<mass>0.4", "<mass>0.5"), ("<pose>0.01", "<pose>0.02")])
def test_links_that_are_their_part_of_a_body_stay_so_where_it_was_edited(old: str, new: str) -> None:
    sdf = _sdf(_HANDS)
    assert old in sdf
    made = twinform.convert(sdf.replace(old, new).encode(), to="urdf")
    assert "tf:shared" not in made.text
    assert 'ixx="0.001"' not in made.text
    assert "stale-carrier" in {each.rule.name for each in made.diagnostics}


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
