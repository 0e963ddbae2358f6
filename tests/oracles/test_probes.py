"""Small URDF files that libsdformat turned into SDF: nothing that it keeps is lost with us without an explanation."""

import pytest

from reports.harness.sample import Sample
from tests.oracles.probe_values import lost, parsed
from tests.oracles.probes import MISSING, PROBES, probes, unexplained
from tests.profile import DEEP


def test_every_difference_from_libsdformat_has_an_explanation():
    if not PROBES.is_dir():
        pytest.skip(MISSING)
    assert [failure for probe in probes(Sample(every=1 if DEEP else 4)) for failure in unexplained(probe)] == []


def _lost(theirs: str, ours: str) -> list[str]:
    first, second = parsed(theirs.encode()), parsed(ours.encode())
    assert first is not None
    assert second is not None
    return [str(part) for part in lost(first, second)]


@pytest.mark.parametrize(
    ("theirs", "ours"),
    [
        ("<a><mu>0.10</mu></a>", "<b><c><mu>1e-1</mu></c></b>"),
        ("<a><static>true</static></a>", "<a><static>1</static></a>"),
        ("<visual name='base_fixed_joint_lump__arm_visual_1'/>", "<visual name='arm_visual_1'/>"),
        ("<visual name='base_fixed_joint_lump__shell_visual'/>", "<visual name='shell'/>"),
        ("<link><pose>1 2 3 0 0 0</pose></link>", "<link/>"),
    ],
    ids=["another place", "another spelling", "a lumped shape", "a named shape", "a pose"],
)
def test_what_is_there_is_not_lost(theirs: str, ours: str):
    assert _lost(theirs, ours) == []


@pytest.mark.parametrize(
    ("theirs", "ours", "expected"),
    [
        ("<a><mu>0.1</mu></a>", "<a><mu>0.2</mu></a>", "a/mu 0.1"),
        ("<a><mu>0.1</mu></a>", "<a><mu2>0.1</mu2></a>", "a/mu 0.1"),
        ("<model><link name='x'/></model>", "<model><link name='y'/></model>", "model/link/@name x"),
    ],
    ids=["another value", "another element", "a name"],
)
def test_what_is_nowhere_is_lost(theirs: str, ours: str, expected: str):
    assert _lost(theirs, ours) == [expected]
