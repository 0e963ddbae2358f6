"""Strategies for links, their masses and shapes."""

from typing import Any

from hypothesis import strategies as st

from twinform.ir import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Format,
    Geometry,
    Inertia,
    Inertial,
    Link,
    Material,
    Mesh,
    Pose,
    Shape,
    Sphere,
    Visual,
)
from twinform.testing.strategies._values import maybe, numbers, poses, vectors

URDF_SHAPES = (Box, Cylinder, Sphere, Mesh)
SDF_SHAPES = (*URDF_SHAPES, Capsule, Ellipsoid)


def inertials(*, whole: bool = False) -> st.SearchStrategy[Inertial]:
    """A mass and the inertia of a box of it, so that it is one that a body can have."""

    def build(pose: Pose | None, mass: float, size: tuple[float, float, float]) -> Inertial:
        x, y, z = (side * side * mass / 12 for side in size)
        inertia = Inertia(ixx=y + z, ixy=0.0, ixz=0.0, iyy=x + z, iyz=0.0, izz=x + y)
        return Inertial(pose=pose, mass=mass, inertia=inertia)

    sizes = vectors(min_value=0.05, max_value=2)
    return st.builds(build, maybe(poses(whole=whole)), numbers(min_value=0.1, max_value=50), sizes)


def geometries(*, shapes: tuple[type[Any], ...] = URDF_SHAPES) -> st.SearchStrategy[Geometry]:
    """One shape of those named, with all its sizes written."""
    size = numbers(min_value=0.001, max_value=10)
    sizes = vectors(min_value=0.001, max_value=10)
    fields: dict[type[Any], st.SearchStrategy[Shape]] = {
        Box: st.builds(Box, size=sizes),
        Cylinder: st.builds(Cylinder, radius=size, length=size),
        Sphere: st.builds(Sphere, radius=size),
        Capsule: st.builds(Capsule, radius=size, length=size),
        Ellipsoid: st.builds(Ellipsoid, radii=sizes),
        Mesh: st.builds(Mesh, uri=st.sampled_from(["package://p/m.stl", "mesh.dae"]), scale=maybe(sizes)),
    }
    unknown = set(shapes) - set(fields)
    if unknown:
        raise ValueError(f"no strategy for the shapes {sorted(shape.__name__ for shape in unknown)}")
    return st.builds(Geometry, shape=st.one_of([fields[shape] for shape in shapes]))


def bodies(format: Format, shapes: tuple[type[Any], ...] | None = None) -> st.SearchStrategy[dict[str, Any]]:
    """The fields of a link besides its name and pose."""
    return _urdf_bodies(shapes or URDF_SHAPES) if format is Format.URDF else _sdf_bodies(shapes or SDF_SHAPES)


def _urdf_bodies(shapes: tuple[type[Any], ...]) -> st.SearchStrategy[dict[str, Any]]:
    shape = {"pose": maybe(poses()), "geometry": geometries(shapes=shapes)}
    color = st.tuples(*[numbers(min_value=0, max_value=1)] * 4)
    material = st.builds(Material, name=st.sampled_from(["red", "blue"]), color=color)
    return st.fixed_dictionaries(
        {
            "inertial": maybe(inertials()),
            "visuals": st.lists(st.builds(Visual, **shape, material=maybe(material)), max_size=2).map(tuple),
            "collisions": st.lists(st.builds(Collision, **shape), max_size=1).map(tuple),
        }
    )


def _sdf_bodies(shapes: tuple[type[Any], ...]) -> st.SearchStrategy[dict[str, Any]]:
    shape = {"pose": maybe(poses(whole=True)), "geometry": geometries(shapes=shapes)}
    return st.fixed_dictionaries(
        {
            "inertial": maybe(inertials(whole=True)),
            "gravity": maybe(st.booleans()),
            "visuals": st.lists(st.builds(Visual, **shape), max_size=2).map(_named("visual")),
            "collisions": st.lists(st.builds(Collision, **shape), max_size=2).map(_named("collision")),
        }
    )


def _named(kind: str) -> Any:
    def name(shapes: list[Any]) -> tuple[Any, ...]:
        return tuple(one.copy(name=f"{kind}_{number}") for number, one in enumerate(shapes))

    return name


def links(*, format: Format | str = Format.URDF, name: str = "link") -> st.SearchStrategy[Link]:
    """Links of a name, with or without mass and shapes, as the format can have them."""
    return bodies(Format(format)).map(lambda body: Link(name=name, **body))
