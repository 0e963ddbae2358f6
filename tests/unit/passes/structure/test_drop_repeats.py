"""`drop-repeats` takes out what is there twice, and nothing else."""

from pathlib import Path

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.structure.drop_repeats import DropRepeats

_ELEMENTS = Path(__file__).parents[3] / "cases" / "elements"


@pytest.mark.parametrize("path", sorted(_ELEMENTS.rglob("*.urdf")), ids=lambda path: path.name)
def test_a_robot_with_every_element_once_stays_as_it_is(path: Path) -> None:
    document, sink = twinform.load(path), DiagnosticSink()
    assert DropRepeats().run(document, sink) == document
    assert not sink.entries


@pytest.mark.parametrize("name", ["calibration", "safety_controller", "limit", "dynamics", "mimic", "axis", "origin"])
def test_the_first_of_two_stays(name: str) -> None:
    one = f'<{name} joint="k" rising="1" k_velocity="1" xyz="1 0 0" lower="0" damping="1" effort="1" velocity="1"/>'
    sink = DiagnosticSink()
    assert DropRepeats().run(_robot(one, one), sink) == _robot(one)
    assert [entry.fate for entry in sink.entries] == ["dropped"]


def _robot(*parts: str) -> Document:
    joint = f'<joint name="j" type="continuous"><parent link="a"/><child link="b"/>{"".join(parts)}</joint>'
    document = twinform.check(f'<robot name="r"><link name="a"/><link name="b"/>{joint}</robot>'.encode()).document
    assert document is not None
    return document
