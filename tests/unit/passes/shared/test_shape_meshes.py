"""Meshes that stand for shapes: closed, as near as they say, and the same bytes each time."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.ir import Box, Cone, Element, Ellipsoid, Geometry, Opaque, Polyline
from twinform.ir.geometry import Vector2
from twinform.ir.node import Vector3
from twinform.passes.mesh_jobs.mesh_files import MARK, NoMeshError
from twinform.passes.shared.outlines import OutlineError, triangulate
from twinform.passes.shared.shape_meshes import ShapeMesh, mesh_of

SIZE = st.floats(0.01, 10)
ERROR = st.none() | st.floats(0.001, 0.2)
SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
HOLE = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]
OTHER_HOLE = [(2.5, 2.5), (2.5, 3.0), (3.0, 3.0), (3.0, 2.5)]
ISLAND = [(1.2, 1.2), (1.8, 1.2), (1.8, 1.8)]


def is_closed(mesh: ShapeMesh) -> bool:
    """Whether each edge has one face on either side."""
    edges = Counter((face[each - 1], face[each]) for face in mesh.faces for each in range(3))
    return all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items())


def volume(mesh: ShapeMesh) -> float:
    total = 0.0
    for face in mesh.faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (mesh.points[each] for each in face)
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def points_inside(mesh: ShapeMesh) -> Iterator[Vector3]:
    """Points of the faces, at their middles and those of their edges."""
    for face in mesh.faces:
        corners = [mesh.points[each] for each in face]
        yield middle(corners)
        yield from (middle(pair) for pair in pairwise([*corners, corners[0]]))


def middle(points: Sequence[Vector3]) -> Vector3:
    x, y, z = (sum(axis) / len(points) for axis in zip(*points, strict=True))
    return x, y, z


def outline(points: Iterable[Vector2]) -> tuple[Element, ...]:
    return tuple(Element(name="point", text=f"{x} {y}") for x, y in points)


def polyline(*outlines: Sequence[Vector2], height: float | None = 2.0) -> Geometry:
    first, *others = map(outline, outlines)
    shape = Polyline(height=height, opaque=tuple(Opaque(element=each) for each in first))
    more = (Opaque(element=Element(name="polyline", children=each)) for each in others)
    return Geometry(shape=shape, opaque=tuple(more))


@examples(0.5)
@given(st.tuples(SIZE, SIZE, SIZE), ERROR)
def test_no_point_of_an_ellipsoid_is_farther_off_than_is_said(radii: Vector3, error: float | None) -> None:
    mesh = mesh_of(Geometry(shape=Ellipsoid(radii=radii)), error and error * max(radii))
    assert is_closed(mesh)
    assert mesh.error <= (error or 0.01) * max(radii) + 1e-12
    scaled = [[p / r for p, r in zip(point, radii, strict=True)] for point in mesh.points]
    assert all(math.isclose(math.hypot(*point), 1) for point in scaled)  # on the surface
    for point in points_inside(mesh):
        unit = math.hypot(*(p / r for p, r in zip(point, radii, strict=True)))
        assert unit <= 1 + 1e-12  # inside
        # the point of the ellipsoid in the same direction is no nearer than the nearest one
        assert math.hypot(*point) * (1 / unit - 1) <= mesh.error * max(radii) / min(radii) + 1e-12
        assert max(radii) * (1 - unit) <= mesh.error + 1e-12


@examples(0.5)
@given(SIZE, SIZE, ERROR)
def test_no_point_of_a_cone_is_farther_off_than_is_said(radius: float, length: float, error: float | None) -> None:
    mesh = mesh_of(Geometry(shape=Cone(radius=radius, length=length)), error and error * radius)
    assert is_closed(mesh)
    assert mesh.error <= (error or 0.01) * radius + 1e-12
    assert {round(z / length, 9) for _, _, z in mesh.points} == {-0.5, 0.5}
    for x, y, z in points_inside(mesh):
        allowed = radius * (0.5 - z / length)
        assert math.hypot(x, y) <= allowed + 1e-9
    rim = [math.hypot(*middle([a, b])[:2]) for a, b in pairwise(mesh.points[1:-1])]
    assert radius - min(rim) <= mesh.error + 1e-12


def test_a_smaller_error_has_more_triangles_and_as_many_as_it_takes() -> None:
    ball = Geometry(shape=Ellipsoid(radii=(1.0, 1.0, 1.0)))
    meshes = [mesh_of(ball, error) for error in (0.1, 0.01, 0.001)]
    assert [len(mesh.faces) for mesh in meshes] == [80, 960, 9800]
    assert volume(meshes[-1]) == pytest.approx(4 / 3 * math.pi, rel=3e-3)


def test_an_obj_file_has_our_mark_and_always_the_same_bytes() -> None:
    mesh = mesh_of(Geometry(shape=Cone(radius=0.1, length=0.2)), 0.03)
    text = mesh.obj().decode()
    assert text.splitlines()[:2] == [f"# {MARK}", "v 0 0 0.1"]
    assert text == mesh_of(Geometry(shape=Cone(radius=0.1, length=0.2)), 0.03).obj().decode()


@pytest.mark.parametrize(
    ("outlines", "area"),
    [
        ([SQUARE], 16),
        ([[*SQUARE, SQUARE[0]]], 16),
        ([SQUARE[::-1]], 16),
        ([SQUARE, HOLE], 15),
        ([SQUARE, HOLE, OTHER_HOLE], 14.75),
        ([SQUARE, HOLE, ISLAND, OTHER_HOLE], 14.93),
        ([SQUARE, [(6.0, 0.0), (7.0, 0.0), (6.0, 1.0)]], 16.5),
        ([[(0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (2.0, 2.0), (0.0, 2.0), (0.5, 1.0)]], 2.5),
        ([[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]], 4),
    ],
)
def test_a_polyline_is_a_prism(outlines: list[list[Vector2]], area: float) -> None:
    mesh = mesh_of(polyline(*outlines), None)
    assert is_closed(mesh)
    assert volume(mesh) == pytest.approx(2 * area)
    assert (min(z for _, _, z in mesh.points), max(z for _, _, z in mesh.points), mesh.error) == (0, 2, 0)


def star(distances: Sequence[float]) -> list[Vector2]:
    turns = (2 * math.pi * each / len(distances) for each in range(len(distances)))
    return [(r * math.cos(turn), r * math.sin(turn)) for r, turn in zip(distances, turns, strict=True)]


@examples(0.5)
@given(st.lists(st.floats(0.5, 3), min_size=3, max_size=40), st.lists(st.floats(0.1, 0.45), min_size=3, max_size=9))
def test_a_star_with_a_star_in_it_has_their_area(outer: list[float], inner: list[float]) -> None:
    # the circle inside of the outer star has no more than this radius
    inside = [distance * math.cos(math.pi / len(outer)) for distance in inner]
    loops, triangles = triangulate([star(outer), star(inside)])
    assert len(triangles) == sum(map(len, loops)) - 2 + 2 * (len(loops) - 1)


@pytest.mark.parametrize(
    ("geometry", "error", "why"),
    [
        (Geometry(shape=Ellipsoid(radii=(1.0, 0.0, 1.0))), None, "not above 0"),
        (Geometry(shape=Ellipsoid(radii=(1.0, math.inf, 1.0))), None, "not above 0"),
        (Geometry(shape=Cone(radius=-1.0)), None, "not above 0"),
        (Geometry(shape=Ellipsoid()), 1e-7, "too many triangles"),
        (Geometry(shape=Box()), None, "no mesh is made of it"),
        (polyline(SQUARE, height=-1.0), None, "height is not above 0"),
        (polyline(SQUARE[:2]), None, "has no area"),
        (polyline([(0, 0), (1, 1), (2, 2)]), None, "has no area"),
        (polyline([(0, 0), (2, 2), (2, 0), (0, 2.5)]), None, "cross"),
        (polyline(SQUARE, [(3.0, 1.0), (5.0, 1.0), (5.0, 2.0)]), None, "cross"),
        (polyline([(math.cos(n), math.sin(n)) for n in range(501)]), None, "more than 500"),
        (polyline([(0, 0), (1, 0), (math.inf, 2)]), None, "not finite"),
    ],
)
def test_no_mesh_stands_for_what_has_no_inside_or_too_many_triangles(
    geometry: Geometry, error: float | None, why: str
) -> None:
    with pytest.raises(NoMeshError, match=why):
        mesh_of(geometry, error)


def test_a_point_that_is_no_point_is_no_outline() -> None:
    shape = Polyline(opaque=(Opaque(element=Element(name="point", text="1 x")),))
    with pytest.raises(NoMeshError, match="not two numbers"):
        mesh_of(Geometry(shape=shape), None)
    with pytest.raises(OutlineError):
        triangulate([])
