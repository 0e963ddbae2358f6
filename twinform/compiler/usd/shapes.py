"""Collisions of a stage: the shapes that USD has, scaled, as those of SDF."""

from collections.abc import Callable, Iterator, Mapping

from twinform.compiler.usd.stage import Prim, Stage, paths_up, scaled
from twinform.ir import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Mesh,
    Plane,
    Shape,
    Sphere,
    Vector3,
)
from twinform.ir.transform import Matrix3, Transform

_TURNS: Mapping[str, Matrix3] = {
    "X": (0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0),
    "Y": (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0),
    "Z": (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
}
"""The rotations that turn z to an axis."""
_ALIKE = 1e-6
"""How much the scales of a sphere may differ, which are numbers of single precision."""


def collisions_of(stage: Stage) -> Iterator[tuple[str, Collision]]:
    """Yield the collisions of rigid bodies, with the paths of these."""
    for path, prim in stage.prims.items():
        body = stage.body_of(path)
        make = _SHAPES.get(prim.type.partition("_")[0])
        if body is not None and make is not None and _collides(stage, path):
            place = stage.prims[body].place.inverse().compose(prim.place)
            if prim.type != "Mesh":
                place = place.compose(Transform(rotation=_TURNS[prim.token("axis", "Z")]))
            geometry = Geometry.unchecked(shape=make(prim))
            yield body, Collision.unchecked(name=prim.name, pose=place.to_pose(), geometry=geometry, source=prim.source)


def _collides(stage: Stage, path: str) -> bool:
    """Whether a shape, or what holds it, is a collider: that may be a reference to shapes which several links share."""
    around = (stage.prims[each] for each in paths_up(path) if each in stage.prims)
    found = next((prim for prim in around if prim.has("PhysicsCollisionAPI") or prim.path in stage.bodies), None)
    return found is not None and found.has("PhysicsCollisionAPI") and found.on("physics:collisionEnabled")


def _box(prim: Prim) -> Shape:
    size = prim.first("size") or 0.0
    return Box.unchecked(size=_positive(scaled((size, size, size), prim.scale)))


def _sphere(prim: Prim) -> Shape:
    radius = prim.first("radius") or 0.0
    radii = _positive(scaled((radius, radius, radius), prim.scale))
    if max(radii) - min(radii) <= _ALIKE * max(radii):
        return Sphere.unchecked(radius=radii[0])
    return Ellipsoid.unchecked(radii=radii)


def _positive(lengths: Vector3) -> Vector3:
    x, y, z = map(abs, lengths)
    return (x, y, z)


def _long(kind: type[Cylinder] | type[Capsule] | type[Cone]) -> Callable[[Prim], Shape]:
    def make(prim: Prim) -> Shape:
        along = "XYZ".index(prim.token("axis", "Z"))
        scale = _positive(prim.scale)
        radius = prim.first("radius", "radiusBottom") or 0.0
        height = prim.first("height") or 0.0
        return kind.unchecked(radius=radius * scale[(along + 1) % 3], length=height * scale[along])

    return make


_SHAPES: Mapping[str, Callable[[Prim], Shape]] = {
    "Cube": _box,
    "Sphere": _sphere,
    "Cylinder": _long(Cylinder),
    "Capsule": _long(Capsule),
    "Cone": _long(Cone),
    "Plane": lambda _: Plane.unchecked(normal=(0.0, 0.0, 1.0)),
    "Mesh": lambda _: Mesh.unchecked(),
}
"""The types of prims that can collide; a type may end in the number of its version."""
