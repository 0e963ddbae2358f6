"""Inertias of shapes, judged by exact quadrature over their cross-sections, by trimesh, and by what must not change."""

import importlib
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Document,
    Ellipsoid,
    Format,
    Geometry,
    Inertia,
    Inertial,
    Link,
    Model,
    Pose,
    Shape,
    Sphere,
)
from twinform.passes import parse_pipeline
from twinform.passes.inertia.fill_inertia import FillInertia

trimesh: Any = importlib.import_module("trimesh")
EXAMPLES = Path(__file__).parents[4] / "examples"
EXACT = 1e-12

SIZES = st.floats(0.01, 10)
SHAPES: dict[str, st.SearchStrategy[Shape]] = {
    "box": st.builds(Box, size=st.tuples(SIZES, SIZES, SIZES)),
    "sphere": st.builds(Sphere, radius=SIZES),
    "ellipsoid": st.builds(Ellipsoid, radii=st.tuples(SIZES, SIZES, SIZES)),
    "cylinder": st.builds(Cylinder, radius=SIZES, length=SIZES),
    "cone": st.builds(Cone, radius=SIZES, length=SIZES),
    "capsule": st.builds(Capsule, radius=SIZES, length=SIZES),
}
ANGLES = st.floats(-math.pi, math.pi)
OFFSETS = st.floats(-5, 5)
POSES = st.builds(Pose, xyz=st.tuples(OFFSETS, OFFSETS, OFFSETS), rpy=st.tuples(ANGLES, ANGLES, ANGLES))

Slices = tuple[float, float, Callable[[Any], Any], Callable[[Any], Any], float]
"""From where to where along z, the half extents along x and y there, and area / (x y)."""


def slices(shape: Any) -> list[Slices]:
    """The cross-sections of a shape: rectangles (area 4 x y) or ellipses (pi x y)."""
    if shape.kind == "box":
        a, b, c = shape.size
        return [(-c / 2, c / 2, lambda z: a / 2 + 0 * z, lambda z: b / 2 + 0 * z, 4.0)]
    if shape.kind in {"sphere", "ellipsoid"}:
        a, b, c = shape.radii if shape.kind == "ellipsoid" else (shape.radius,) * 3
        return [(-c, c, lambda z: a * _arc(z / c), lambda z: b * _arc(z / c), math.pi)]
    r, h = shape.radius, shape.length
    if shape.kind == "cone":
        return [(-h / 2, h / 2, lambda z: r * (0.5 - z / h), lambda z: r * (0.5 - z / h), math.pi)]
    middle: Slices = (-h / 2, h / 2, lambda z: r + 0 * z, lambda z: r + 0 * z, math.pi)
    if shape.kind == "cylinder":
        return [middle]
    top: Slices = (h / 2, h / 2 + r, lambda z: r * _arc((z - h / 2) / r), lambda z: r * _arc((z - h / 2) / r), math.pi)
    end: Slices = (
        -h / 2 - r,
        -h / 2,
        lambda z: r * _arc((z + h / 2) / r),
        lambda z: r * _arc((z + h / 2) / r),
        math.pi,
    )
    return [middle, top, end]


def _arc(z: Any) -> Any:
    return np.sqrt(1 - z * z)


def moments(shape: Any) -> tuple[float, Any, Any]:
    """Volume, first and second moments about the origin, by Gauss: exact, as all of them are polynomials of z."""
    points, weights = np.polynomial.legendre.leggauss(8)
    volume, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for low, high, x, y, factor in slices(shape):
        z, w = (high - low) / 2 * points + (high + low) / 2, (high - low) / 2 * weights
        area = w * factor * x(z) * y(z)
        spread = 1 / 3 if factor == 4.0 else 1 / 4  # of a rectangle and of an ellipse, by the square of the half extent
        volume += area.sum()
        first += np.array([0, 0, (area * z).sum()])
        second += np.diag([(area * spread * x(z) ** 2).sum(), (area * spread * y(z) ** 2).sum(), (area * z * z).sum()])
    return volume, first, second


def rotation(pose: Pose) -> Any:
    roll, pitch, yaw = pose.rpy or (0, 0, 0)
    about_x = [[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]]
    about_y = [[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]]
    about_z = [[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]]
    return np.array(about_z) @ np.array(about_y) @ np.array(about_x)


def expected(parts: list[tuple[Any, Pose]], density: float) -> tuple[float, Any, Any]:
    """Mass, center and inertia about it, of shapes at their poses."""
    mass, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for shape, pose in parts:
        volume, own_first, own_second = moments(shape)
        turn, move = rotation(pose), np.array(pose.xyz or (0, 0, 0))
        turned = turn @ own_first
        mass += density * volume
        first += density * (turned + volume * move)
        cross = np.outer(turned, move)
        second += density * (turn @ own_second @ turn.T + cross + cross.T + volume * np.outer(move, move))
    center = first / mass
    spread = second - mass * np.outer(center, center)
    return mass, center, np.trace(spread) * np.eye(3) - spread


def link(*parts: tuple[Any, Pose], inertial: Inertial | None = None, name: str = "part") -> Link:
    collisions = tuple(Collision(geometry=Geometry(shape=shape), pose=pose) for shape, pose in parts)
    return Link(name=name, collisions=collisions, inertial=inertial)


def filled(options: FillInertia, *links: Link, format_: Format = Format.URDF) -> tuple[Link, ...]:
    document = Document(format=format_, models=(Model(name="robot", links=links),))
    return options.run(document, DiagnosticSink()).models[0].links


def numbers(one: Link) -> tuple[float, Any, Any]:
    inertial = one.inertial
    assert inertial
    assert inertial.inertia
    i = inertial.inertia
    matrix = np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])
    return inertial.mass or 0.0, np.array(inertial.pose.xyz if inertial.pose else (0, 0, 0)), matrix


def assert_same(found: tuple[float, Any, Any], wanted: tuple[float, Any, Any], reach: float) -> None:
    mass, center, inertia = wanted
    assert found[0] == pytest.approx(mass, rel=EXACT)
    assert np.abs(found[1] - center).max() <= EXACT * reach
    assert np.abs(found[2] - inertia).max() <= EXACT * mass * reach**2


@pytest.mark.parametrize("kind", SHAPES)
def test_each_shape_agrees_with_its_closed_form(kind: str) -> None:
    @given(SHAPES[kind], POSES, st.floats(1, 10000))
    def judge(shape: Any, pose: Pose, density: float) -> None:
        found = filled(FillInertia(density=density), link((shape, pose)))[0]
        assert_same(numbers(found), expected([(shape, pose)], density), 30)

    judge()


@given(st.lists(st.tuples(st.one_of(*SHAPES.values()), POSES), min_size=2, max_size=5))
def test_several_shapes_are_summed_with_parallel_axes(parts: list[tuple[Any, Pose]]) -> None:
    found = filled(FillInertia(density=700), link(*parts))[0]
    assert_same(numbers(found), expected(parts, 700), 30)


@given(st.one_of(*SHAPES.values()), POSES)
def test_filling_twice_is_filling_once(shape: Any, pose: Pose) -> None:
    once = filled(FillInertia(), link((shape, pose)))
    assert filled(FillInertia(), *once) == once
    again = filled(FillInertia(replace="all"), *once)
    assert_same(numbers(again[0]), numbers(once[0]), 30)


def test_meshes_of_a_robot_agree_with_trimesh() -> None:
    path = EXAMPLES / "arm.urdf"
    made = twinform.convert(path, to="urdf", passes="fill-inertia{replace=all density=1234 shapes=visual}")
    judged = 0
    for one in made.document.models[0].links:
        uris = [getattr(each.geometry.shape, "uri", None) for each in one.visuals if each.geometry]
        if len(uris) != 1 or not uris[0] or one.visuals[0].pose:
            continue
        mesh = trimesh.load_mesh(EXAMPLES / uris[0].removeprefix("package://"))
        mesh.apply_scale(getattr(one.visuals[0].geometry and one.visuals[0].geometry.shape, "scale", None) or 1)
        mesh.density = 1234
        assert_same(numbers(one), (mesh.mass, mesh.center_mass, mesh.moment_inertia), 1)
        judged += 1
    assert judged > 2


GOOD = Inertial(mass=2.0, inertia=Inertia(ixx=1.0, iyy=1.0, izz=1.0, ixy=0, ixz=0, iyz=0))
BALL = (Sphere(radius=1.0), Pose())
WRITTEN: dict[str, tuple[dict[str, Any], Inertial | None, float | None]] = {
    "water by default": ({}, None, 1000 * 4 / 3 * math.pi),
    "a density": ({"density": 10}, None, 10 * 4 / 3 * math.pi),
    "a mass": ({"mass": 7}, None, 7),
    "a total": ({"total_mass": 9}, None, 9),
    "what is written stays": ({"mass": 7}, GOOD, None),
    "a mass without an inertia is kept": ({"mass": 7}, Inertial(mass=2.0), 2),
    "a mass that is written is kept": ({"replace": "all"}, GOOD, 2),
    "unless an amount is given": ({"replace": "all", "density": 10}, GOOD, 10 * 4 / 3 * math.pi),
    "a mass of zero is none": ({"mass": 7, "replace": "impossible"}, GOOD.copy(mass=0.0), 7),
    "an automatic inertia is left": ({"replace": "impossible"}, Inertial(auto=True), None),
    "unless all are replaced": ({"mass": 7, "replace": "all"}, Inertial(auto=True), 7),
}


@pytest.mark.parametrize("case", WRITTEN)
def test_what_becomes_of_a_mass_that_is_written(case: str) -> None:
    options, inertial, mass = WRITTEN[case]
    before = link(BALL, inertial=inertial)
    after = filled(FillInertia(**options), before, format_=Format.SDF)[0]
    if mass is None:
        assert after is before
    else:
        assert after.inertial
        assert after.inertial.auto is None
        found = numbers(after)
        assert found[0] == pytest.approx(mass)
        assert found[2][0][0] == pytest.approx(2 / 5 * mass)


HUGE = (Sphere(radius=1e200), Pose())
FLAT = (Box(size=(1.0, 1.0, 0.0)), Pose())


@pytest.mark.parametrize("part", [HUGE, FLAT, (None, Pose())], ids=["huge", "flat", "no shape"])
def test_a_shape_without_a_volume_fills_nothing(part: tuple[Any, Pose]) -> None:
    sink, before = DiagnosticSink(), Document(format=Format.URDF, models=(Model(name="r", links=(link(part),)),))
    assert FillInertia().run(before, sink) is before
    assert [each.rule.name for each in sink.diagnostics] == ["unfilled-inertia"]


@pytest.mark.parametrize("options", ["density=0", "mass=-1", "total-mass=inf", "density=1 mass=1", "replace=some"])
def test_options_that_mean_nothing_are_refused(options: str) -> None:
    with pytest.raises(ValueError, match="fill-inertia"):
        parse_pipeline(f"fill-inertia{{{options}}}")
