"""Hypothesis strategies for models: valid by construction, and built so that failures shrink to a few links.

A model is drawn as a list of *segments*, each a link with the joint that holds it and a number that picks its parent
among the links before it. Names and parents follow from positions, so that a segment can be taken out without harm.
"""

from typing import Any

from hypothesis import strategies as st

from twinform.ir import (
    Axis,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Document,
    Dynamics,
    Ellipsoid,
    Format,
    Frame,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Model,
    Pose,
    Shape,
    Sphere,
    Visual,
)

__all__ = ["geometries", "inertials", "numbers", "poses", "robots", "sdf_models", "vectors"]

_FEW = (0.0, 1.0, -0.5, 0.25, 1e-3)
_URDF_SHAPES = (Box, Cylinder, Sphere, Mesh)
_SDF_SHAPES = (*_URDF_SHAPES, Capsule, Ellipsoid)


def numbers(*, min_value: float = -1e3, max_value: float = 1e3) -> st.SearchStrategy[float]:
    """Finite numbers, simple ones first."""
    simple = [value for value in _FEW if min_value <= value <= max_value] or [min_value]
    return st.sampled_from(simple) | st.floats(min_value, max_value, allow_nan=False, width=64)


def vectors(*, min_value: float = -10, max_value: float = 10) -> st.SearchStrategy[tuple[float, float, float]]:
    """Three numbers, in metres or radians as it comes."""
    each = numbers(min_value=min_value, max_value=max_value)
    return st.tuples(each, each, each)


def _maybe(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.none() | strategy


def poses(*, whole: bool = False) -> st.SearchStrategy[Pose]:
    """Poses of roll, pitch and yaw that say something; `whole` ones say both parts, as SDF must."""
    if whole:
        return st.builds(Pose, xyz=vectors(), rpy=vectors(min_value=-3.2, max_value=3.2))
    parts = st.tuples(_maybe(vectors()), _maybe(vectors(min_value=-3.2, max_value=3.2)))
    return parts.filter(lambda pair: pair != (None, None)).map(lambda pair: Pose(xyz=pair[0], rpy=pair[1]))


def inertials(*, whole: bool = False) -> st.SearchStrategy[Inertial]:
    """A mass and the inertia of a box of it, so that it is one that a body can have."""

    def build(pose: Pose | None, mass: float, size: tuple[float, float, float]) -> Inertial:
        x, y, z = (side * side * mass / 12 for side in size)
        inertia = Inertia(ixx=y + z, ixy=0.0, ixz=0.0, iyy=x + z, iyz=0.0, izz=x + y)
        return Inertial(pose=pose, mass=mass, inertia=inertia)

    sizes = vectors(min_value=0.05, max_value=2)
    return st.builds(build, _maybe(poses(whole=whole)), numbers(min_value=0.1, max_value=50), sizes)


def geometries(*, shapes: tuple[type[Any], ...] = _URDF_SHAPES) -> st.SearchStrategy[Geometry]:
    """One shape of those named, with all its sizes written."""
    size = numbers(min_value=0.001, max_value=10)
    sizes = vectors(min_value=0.001, max_value=10)
    fields: dict[type[Any], st.SearchStrategy[Shape]] = {
        Box: st.builds(Box, size=sizes),
        Cylinder: st.builds(Cylinder, radius=size, length=size),
        Sphere: st.builds(Sphere, radius=size),
        Capsule: st.builds(Capsule, radius=size, length=size),
        Ellipsoid: st.builds(Ellipsoid, radii=sizes),
        Mesh: st.builds(Mesh, uri=st.sampled_from(["package://p/m.stl", "mesh.dae"]), scale=_maybe(sizes)),
    }
    unknown = set(shapes) - set(fields)
    if unknown:
        raise ValueError(f"no strategy for the shapes {sorted(shape.__name__ for shape in unknown)}")
    return st.builds(Geometry, shape=st.one_of([fields[shape] for shape in shapes]))


def robots(*, max_links: int = 8) -> st.SearchStrategy[Document]:
    """URDF documents: a tree of links with joints of every type but planar, as the front end reads them."""
    shape = {"pose": _maybe(poses()), "geometry": geometries()}
    color = st.tuples(*[numbers(min_value=0, max_value=1)] * 4)
    material = st.builds(Material, name=st.sampled_from(["red", "blue"]), color=color)
    body = st.fixed_dictionaries(
        {
            "inertial": _maybe(inertials()),
            "visuals": st.lists(st.builds(Visual, **shape, material=_maybe(material)), max_size=2).map(tuple),
            "collisions": st.lists(st.builds(Collision, **shape), max_size=1).map(tuple),
        }
    )
    types = st.sampled_from(["fixed", "revolute", "continuous", "prismatic", "floating"])
    segment = st.tuples(body, types, _maybe(poses()), _axes(), st.integers(0, 7))
    return st.lists(segment, min_size=1, max_size=max_links).map(_robot)


def _axes() -> st.SearchStrategy[Axis]:
    span = st.tuples(numbers(min_value=-3, max_value=0), numbers(min_value=0, max_value=3))
    strength = numbers(min_value=0, max_value=100)

    def limit(ends: tuple[float, float], effort: float, velocity: float) -> Limit:
        return Limit(lower=ends[0], upper=ends[1], effort=effort, velocity=velocity)

    limits = st.builds(limit, span, strength, strength)
    dynamics = st.builds(Dynamics, damping=strength, friction=_maybe(strength))
    directions = st.sampled_from([(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.8, 0.0)])
    return st.builds(Axis, xyz=directions, limit=limits, dynamics=_maybe(dynamics))


_NOT_MOVING = frozenset({"fixed", "floating"})


def _robot(segments: list[tuple[dict[str, Any], Any, Pose | None, Axis, int]]) -> Document:
    links: list[Link] = []
    joints: list[Joint] = []
    for number, (body, kind, pose, axis, pick) in enumerate(segments):
        placed = Pose(relative_to=f"joint_{number}") if number else None
        links.append(Link(name=f"link_{number}", pose=placed, **body))
        if number:
            parent = f"link_{pick % number}"
            origin = (pose or Pose()).model_copy(update={"relative_to": parent})
            joints.append(
                Joint(
                    name=f"joint_{number}",
                    type=kind,
                    parent=parent,
                    child=f"link_{number}",
                    pose=origin,
                    axis=None if kind in _NOT_MOVING else axis,
                )
            )
    model = Model(name="robot", links=tuple(links), joints=tuple(joints))
    return Document(format=Format.URDF, models=(model,))


def sdf_models(*, version: str = "1.11", max_links: int = 8) -> st.SearchStrategy[Document]:
    """SDF documents of 1.8 or newer: a model whose links, joints and frames are posed in one another."""
    names = ("visuals", "collisions")
    shape = {"pose": _maybe(poses(whole=True)), "geometry": geometries(shapes=_SDF_SHAPES)}
    body = st.fixed_dictionaries(
        {
            "inertial": _maybe(inertials(whole=True)),
            "gravity": _maybe(st.booleans()),
            names[0]: st.lists(st.builds(Visual, **shape), max_size=2).map(_named("visual")),
            names[1]: st.lists(st.builds(Collision, **shape), max_size=2).map(_named("collision")),
        }
    )
    segment = st.tuples(body, _movements(), poses(whole=True), poses(whole=True), st.integers(0, 7), st.booleans())
    return st.lists(segment, min_size=1, max_size=max_links).map(lambda segments: _sdf_model(segments, version))


def _movements() -> st.SearchStrategy[dict[str, Any]]:
    """What a joint of SDF says about how it moves; nothing at all where there is none."""
    axis, pitch = _axes(), numbers(min_value=0.1, max_value=3)
    one, two = {"axis": axis}, {"axis": axis, "axis2": axis}
    fields: dict[str, dict[str, st.SearchStrategy[Any]]] = {
        **dict.fromkeys(("revolute", "continuous", "prismatic"), one),
        **dict.fromkeys(("universal", "revolute2"), two),
        "screw": {**one, "screw_thread_pitch": _maybe(pitch)},
        "fixed": {},
        "ball": {},
    }
    kinds = [st.fixed_dictionaries({"type": st.just(kind), **inside}) for kind, inside in fields.items()]
    return st.one_of(st.just({}), *kinds)


def _named(kind: str) -> Any:
    def name(shapes: list[Any]) -> tuple[Any, ...]:
        return tuple(one.model_copy(update={"name": f"{kind}_{number}"}) for number, one in enumerate(shapes))

    return name


def _sdf_model(segments: list[Any], version: str) -> Document:
    links: list[Link] = []
    joints: list[Joint] = []
    frames: list[Frame] = []
    for number, (body, movement, pose, frame_pose, pick, framed) in enumerate(segments):
        parent = f"link_{pick % number}" if number else None
        placed = pose.model_copy(update={"relative_to": parent})
        links.append(Link(name=f"link_{number}", pose=placed, **body))
        if framed:
            frames.append(Frame(name=f"frame_{number}", attached_to=f"link_{number}", pose=frame_pose))
        if number and movement:
            child = f"link_{number}"
            joints.append(Joint(name=f"joint_{number}", parent=parent, child=child, pose=frame_pose, **movement))
    model = Model(name="model", links=tuple(links), joints=tuple(joints), frames=tuple(frames))
    return Document(format=Format.SDF, version=version, models=(model,))
