"""What is drawn, in numbers: triangles of shapes, boxes of inertias, ends of sliders, and where a camera has points."""

import math
from unittest.mock import MagicMock

import pytest

pytest.importorskip("viser", reason="viser is not installed")

from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.browser.camera import Camera
from twinform.compiler.kinematics import Degree
from twinform.compiler.scene import build_scene
from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Heightmap, Mesh, Plane, Sphere
from twinform.ir.geometry import ShapeNode
from twinform.ir.solids import Solid
from twinform.view.figure import Figure
from twinform.view.joint_controls import slider_range
from twinform.view.layers import inertia_box
from twinform.view.triangles import STAND_IN, MeshDrawings, triangles_of

_SHAPES = [
    (Box(size=(1, 2, 3)), (1, 2, 3)),
    (Cylinder(radius=0.5, length=2), (1, 1, 2)),
    (Cone(radius=0.5, length=2), (1, 1, 2)),
    (Sphere(radius=0.5), (1, 1, 1)),
    (Capsule(radius=0.5, length=2), (1, 1, 3)),
    (Ellipsoid(radii=(1, 2, 3)), (2, 4, 6)),
    (Plane(size=(4, 5)), (4, 5, 0)),
    (Plane(normal=(1, 0, 0), size=(4, 5)), (0, 5, 4)),
]


@pytest.mark.parametrize(("shape", "extent"), _SHAPES, ids=lambda each: getattr(each, "kind", ""))
def test_triangles_fill_the_extent_of_their_shape_about_its_origin(shape: ShapeNode, extent: tuple[float, ...]):
    found = triangles_of(shape, MeshDrawings())
    assert found.problem == ""
    least, greatest = found.points.min(axis=0), found.points.max(axis=0)
    assert sorted(greatest - least) == pytest.approx(sorted(extent), abs=0.01)
    assert greatest + least == pytest.approx((0, 0, 0), abs=1e-6)
    assert found.faces.max() < len(found.points)


@pytest.mark.parametrize(
    ("shape", "problem"),
    [
        (Box(size=(0, 1, 1)), "zero"),
        (Box(size=(math.nan, 1, 1)), "not finite"),
        (Sphere(radius=1e300), "beyond what can be drawn"),
        (Mesh(), "names no mesh"),
        (Mesh(uri="gone.stl"), "gone.stl"),
        (Heightmap(uri="hills.png"), "heightmap"),
    ],
    ids=["flat", "nan", "huge", "no mesh", "missing mesh", "heightmap"],
)
def test_what_cannot_be_drawn_is_a_box_that_says_why(shape: ShapeNode, problem: str):
    found = triangles_of(shape, MeshDrawings())
    assert problem in found.problem
    assert found.points.max() == pytest.approx(STAND_IN / 2)


@given(st.tuples(*[st.floats(0.01, 10)] * 3), st.floats(0.01, 100))
def test_the_box_of_an_inertia_is_the_box_that_has_it(size: tuple[float, float, float], mass: float):
    x, y, z = size
    inertia = (mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12, 0.0, 0.0, 0.0)
    found = inertia_box(Solid(mass, (1, 2, 3), inertia))
    assert found is not None
    lengths, pose = found
    assert sorted(lengths) == pytest.approx(sorted(size), rel=1e-4, abs=1e-4 * max(size))
    assert pose.translation == (1, 2, 3)


def test_an_inertia_of_no_body_has_a_box_and_one_that_is_not_finite_has_none():
    assert inertia_box(Solid(1, (0, 0, 0), (9, 1, 1, 0, 0, 0)))
    assert inertia_box(Solid(1, (0, 0, 0), (math.nan, 1, 1, 0, 0, 0))) is None


_ENDS = st.floats(-100, 100) | st.sampled_from((-math.inf, math.inf, math.nan, 0.0))


@given(_ENDS, _ENDS, st.booleans())
def test_a_slider_has_some_way_unless_its_joint_is_locked(lower: float, upper: float, slides: bool):
    least, greatest = slider_range(Degree((0, 0, 1), slides=slides, lower=lower, upper=upper))
    assert math.isfinite(least)
    assert math.isfinite(greatest)
    assert least < greatest or lower == upper == least == greatest


def test_a_slider_has_the_limits_of_its_joint():
    assert slider_range(Degree((0, 0, 1), slides=False, lower=-1, upper=2)) == (-1, 2)
    assert slider_range(Degree((0, 0, 1), slides=False, lower=-math.inf, upper=math.inf)) == (-math.pi, math.pi)


def test_a_camera_has_its_target_in_the_middle_and_what_is_above_it_above():
    camera = Camera((3, 0, 0), (0, 0, 0))
    middle, above, left, behind = camera.pixels([(0, 0, 0), (0, 0, 1), (0, -1, 0), (9, 0, 0)], 200, 100)
    assert middle == pytest.approx((100, 50))
    assert above[1] < 50
    assert left[0] < 100
    assert math.isnan(behind[0])


@pytest.mark.parametrize("height", [5, -5])
def test_a_camera_may_look_straight_down_or_up(height: float):
    camera = Camera((0, 0, height), (0, 0, 0))
    assert camera.pixels([(0, 0, 0)], 200, 100)[0] == pytest.approx((100, 50))
    assert math.hypot(*camera.wxyz) == pytest.approx(1)


_PLANE = "<plane><normal>0 0 1</normal><size>{0} {0}</size></plane>"
_MODEL = """<model name="{}"><link name="l"><visual name="v">
<geometry>{}</geometry></visual></link></model>"""
_CRATE = _MODEL.format("crate", "<box><size>1 2 1</size></box>")


@pytest.mark.parametrize(
    ("models", "size", "ground"),
    [
        ((_CRATE,), math.sqrt(6), False),
        ((_MODEL.format("ground", _PLANE.format(30)), _CRATE), math.sqrt(6), True),
        ((_MODEL.format("ground", _PLANE.format(1)), _CRATE), math.sqrt(6), False),
        ((_MODEL.format("ground", "<box><size>60 60 1</size></box>"), _CRATE), math.sqrt(6), True),
        ((_MODEL.format("ground", _PLANE.format(3)),), math.sqrt(18), False),
    ],
    ids=["alone", "on a plane", "on a mat", "on a wide box", "a plane alone"],
)
def test_what_is_seen_is_what_stands_on_the_ground(models: tuple[str, ...], size: float, ground: bool):
    text = f'<sdf version="1.11"><world name="w">{"".join(models)}</world></sdf>'
    figure = Figure(MagicMock(), "/A", build_scene(twinform.loads(text.encode())), MeshDrawings())
    assert figure.size == pytest.approx(size)
    assert figure.has_ground is ground
