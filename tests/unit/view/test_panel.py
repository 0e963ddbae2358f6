"""What moves when a part is dragged, and how far."""

import math

import pytest

pytest.importorskip("viser", reason="viser is not installed")

from tests.browser.test_view import ARM
from twinform.compiler import LoadOptions
from twinform.view import read_subject
from twinform.view.figure import Figure
from twinform.view.measuring import curve, gravity_effort, lines_between
from twinform.view.panel import Drag, drag_of
from twinform.view.triangles import MeshDrawings


class _Nothing:
    """What draws nothing, with the names that viser would have."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self.position, self.wxyz = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)

    def add_frame(self, name: str, **_: object) -> "_Nothing":
        return _Nothing(name)


@pytest.fixture
def figure() -> Figure:
    subject, _ = read_subject(ARM.encode(), LoadOptions())
    assert subject is not None
    return Figure(_Nothing(), "/1/A", subject.scene, MeshDrawings())


def _drag(figure: Figure, link: str, positions: dict[tuple[str, int], float], at: tuple[float, float, float]) -> Drag:
    figure.move(positions)
    found = drag_of(figure, link, figure.poses[link].apply(at), positions)
    assert found is not None
    return found


def test_the_base_does_not_move(figure: Figure):
    assert drag_of(figure, "base", (0, 0, 0), {}) is None


@pytest.mark.parametrize(("link", "joint"), [("upper", "shoulder"), ("slider", "slide"), ("follower", "slide")])
def test_the_nearest_joint_moves_that_follows_no_other(figure: Figure, link: str, joint: str):
    assert _drag(figure, link, {}, (0, 0, 0.1)).joint.name == joint


@pytest.mark.parametrize("shoulder", [0.0, 0.4, -1.0])
@pytest.mark.parametrize(("link", "key", "target"), [("upper", ("shoulder", 0), 1.2), ("slider", ("slide", 0), 0.15)])
def test_the_grip_follows_the_pointer(figure: Figure, shoulder: float, link: str, key: tuple[str, int], target: float):
    """Wherever a part is after a motion of its joint, dragging its grip there gives that motion."""
    before = {("shoulder", 0): shoulder}
    grip = (0.02, 0.01, 0.3)
    drag = _drag(figure, link, before, grip)
    there = figure.scene.kinematics().poses(before | {key: target})[link].apply(grip)
    assert drag.position_at(there) == pytest.approx(target)


def test_it_turns_the_shorter_way(figure: Figure):
    drag = _drag(figure, "upper", {}, (0, 0, 0.3))
    assert abs(drag.position_at((-0.001, 0, -1))) <= math.pi


def test_a_pendulum_pulls_with_the_sine_of_its_angle():
    text = """<robot name="r"><link name="a"/><link name="b"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
      <joint name="j" type="continuous"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/>
      </joint></robot>"""
    subject, _ = read_subject(text.encode(), LoadOptions())
    assert subject is not None
    swing = Figure(_Nothing(), "/1/A", subject.scene, MeshDrawings())
    for angle in (-1.0, 0.0, 0.3, math.pi / 2):
        effort = gravity_effort(swing, ("j", 0), {("j", 0): angle})
        assert effort == pytest.approx(9.8 * 2 * 0.5 * math.sin(angle), abs=1e-6)
    swing.move({("j", 0): math.pi / 2})
    distance, place, turned = lines_between(swing.poses["a"], swing.poses["b"])
    assert (distance, place, turned) == ("distance 1 m", "xyz 1 0 0 m", "rpy 0 90 0 degrees")


def test_masses_beyond_all_measure_have_an_effort_that_is_no_number():
    moments = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    mass = f'<inertial><origin xyz="0 0 {{}}"/><mass value="1e308"/>{moments}</inertial>'
    text = f"""<robot name="r"><link name="a">{mass.format(1e9)}</link><link name="b">{mass.format(-1e9)}</link>
      <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>"""
    subject, _ = read_subject(text.encode(), LoadOptions())
    assert subject is not None
    effort = gravity_effort(Figure(_Nothing(), "/1/A", subject.scene, MeshDrawings()), ("j", 0), {})
    assert math.isnan(effort)
    assert "nan" in curve([0.0, 1.0], [effort, effort])
