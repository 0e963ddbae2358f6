import math

import pytest

from twinform.ir import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Link,
    Mesh,
    Model,
    Pose,
    Shape,
    Sphere,
)
from twinform.passes.plugins.wheels import lowest_point

LYING, TILTED = (0.0, math.pi / 2, 0.0), (0.0, math.pi / 4, 0.0)
CASES: dict[str, tuple[Shape, tuple[float, float, float] | None, float]] = {
    "a box": (Box(size=(1, 2, 3)), None, 1.5),
    "a box on its side": (Box(size=(1, 2, 3)), LYING, 0.5),
    "a box on its edge": (Box(size=(2, 2, 2)), TILTED, math.sqrt(2)),
    "a ball": (Sphere(radius=0.3), TILTED, 0.3),
    "a standing cylinder": (Cylinder(radius=0.1, length=1), None, 0.5),
    "a wheel": (Cylinder(radius=0.1, length=1), LYING, 0.1),
    "a tilted cylinder": (Cylinder(radius=1, length=2), TILTED, math.sqrt(2)),
    "a capsule": (Capsule(radius=0.1, length=1), None, 0.6),
    "a capsule on its side": (Capsule(radius=0.1, length=1), LYING, 0.1),
    "a cone": (Cone(radius=1, length=2), None, 1.0),
    "a cone on its tip": (Cone(radius=1, length=2), (math.pi, 0.0, 0.0), 1.0),
    "a cone on its side": (Cone(radius=1, length=2), LYING, 1.0),
    "a cone of the usual size on its side": (Cone(), LYING, 1.0),
    "an ellipsoid": (Ellipsoid(radii=(1, 2, 3)), None, 3.0),
    "an ellipsoid on its side": (Ellipsoid(radii=(1, 2, 3)), LYING, 1.0),
}


def model(shape: Shape | None, rpy: tuple[float, float, float] | None = None) -> Model:
    geometry = Geometry(shape=shape)
    collision = Collision(pose=Pose(xyz=(0, 0, 0.25), rpy=rpy), geometry=geometry)
    return Model(name="r", links=(Link(name="l", pose=Pose(xyz=(0, 0, 1)), collisions=(collision,)),))


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_shapes_reach_down(case: tuple[Shape, tuple[float, float, float] | None, float]) -> None:
    shape, rpy, reach = case
    assert lowest_point(model(shape, rpy)) == pytest.approx(1.25 - reach)


def test_what_is_not_known_is_not_guessed() -> None:
    assert lowest_point(model(Mesh(uri="a.stl"))) is None
    assert lowest_point(model(None)) is None
    assert lowest_point(Model(name="r", links=(Link(name="l"),))) is None


def test_nested_models_count() -> None:
    inner = model(Sphere(radius=2)).copy(name="inner", pose=Pose(xyz=(0, 0, -1)))
    assert lowest_point(Model(name="r", models=(inner,))) == pytest.approx(-1.75)


def test_a_circle_of_frames_is_none_of_our_business() -> None:
    link = Link(name="l", pose=Pose(relative_to="l"), collisions=model(Sphere(radius=1)).links[0].collisions)
    assert lowest_point(Model(name="r", links=(link,))) is None
