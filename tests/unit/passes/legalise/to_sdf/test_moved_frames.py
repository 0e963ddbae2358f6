"""What was a link or its joint in URDF, and was moved in SDF: each trip after that leaves it where it is."""

import re
from pathlib import Path

import pytest

import twinform
from testbed.edits import Edit
from twinform.ir.kinematic_tree import KinematicTree

_CASE = Path(__file__).parents[4] / "cases" / "edits" / "moved_tool.urdf"
_EDITS = re.findall(r"<!-- edit: (.*?) -->", _CASE.read_text(encoding="utf-8"))


@pytest.mark.parametrize("edit", _EDITS)
def test_a_moved_frame_is_written_alike_on_every_trip(edit: str) -> None:
    edited = Edit.from_text(edit).apply(twinform.convert(_CASE, to="sdf").text.encode())
    urdf = twinform.convert(edited, to="urdf").text.encode()
    again = twinform.convert(twinform.convert(urdf, to="sdf").text.encode(), to="urdf").text.encode()
    assert again == urdf
    flange = KinematicTree(twinform.loads(again).models[0]).link("flange")
    assert [shape.name for shape in flange.visuals] == ["plate"]


def test_a_moved_frame_is_elsewhere_for_all_readers_of_the_urdf() -> None:
    edited = Edit.from_text(_EDITS[0]).apply(twinform.convert(_CASE, to="sdf").text.encode())
    mount = KinematicTree(twinform.convert(edited, to="urdf").document.models[0]).joint("mount")
    assert mount.pose is not None
    assert (mount.pose.xyz, mount.pose.rpy) == ((0.3, 0.0, 1.0), (0.0, 0.1, 0.0))
