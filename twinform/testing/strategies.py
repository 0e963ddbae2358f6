"""Hypothesis strategies for models: valid by construction, and built so that failures shrink to a few links.

A model is drawn as a list of *segments*, each a link with the joint that holds it and a number that picks its parent
among the links before it. Names and parents follow from positions, so that a segment can be taken out without harm.
Arguments are keyword-only and describe valid values; one that no value can satisfy raises `ValueError`.
"""

import math
from typing import Any

from hypothesis import strategies as st

from twinform.ir import (
    Axis,
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Document,
    Dynamics,
    Element,
    Ellipsoid,
    Format,
    Frame,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    JointType,
    Limit,
    Link,
    Material,
    Mesh,
    Model,
    Opaque,
    Polyline,
    Pose,
    Shape,
    Sphere,
    Visual,
    World,
)
from twinform.request_options import UrdfVersion

__all__ = [
    "geometries",
    "inertials",
    "joints",
    "links",
    "numbers",
    "poses",
    "robots",
    "sdf_models",
    "vectors",
    "worlds",
]
_SIMPLE = (0.0, 1.0, -0.5, 0.25, 1e-3)


def numbers(*, min_value: float = -1e3, max_value: float = 1e3) -> st.SearchStrategy[float]:
    """Draw finite numbers, simple ones first."""
    simple = [value for value in _SIMPLE if min_value <= value <= max_value] or [min_value]
    return st.sampled_from(simple) | st.floats(min_value, max_value, allow_nan=False, width=64)


def vectors(*, min_value: float = -10, max_value: float = 10) -> st.SearchStrategy[tuple[float, float, float]]:
    """Draw three numbers, such as a position in m or angles in rad."""
    each = numbers(min_value=min_value, max_value=max_value)
    return st.tuples(each, each, each)


def _maybe(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.none() | strategy


def poses(*, whole: bool = False) -> st.SearchStrategy[Pose]:
    """Draw poses of a position, roll, pitch and yaw, or one of both; `whole` ones have both parts, as SDF needs."""
    if whole:
        return st.builds(Pose, xyz=vectors(), rpy=vectors(min_value=-3.2, max_value=3.2))
    parts = st.tuples(_maybe(vectors()), _maybe(vectors(min_value=-3.2, max_value=3.2)))
    return parts.filter(lambda pair: pair != (None, None)).map(lambda pair: Pose(xyz=pair[0], rpy=pair[1]))


URDF_TYPES: tuple[JointType, ...] = ("fixed", "revolute", "continuous", "prismatic", "floating")
_NOT_MOVING = frozenset({"fixed", "floating"})


def _axes() -> st.SearchStrategy[Axis]:
    """Draw axes with limits, and perhaps with damping and friction."""
    span = st.tuples(numbers(min_value=-3, max_value=0), numbers(min_value=0, max_value=3))
    strength = numbers(min_value=0, max_value=100)

    def limit(ends: tuple[float, float], effort: float, velocity: float) -> Limit:
        return Limit(lower=ends[0], upper=ends[1], effort=effort, velocity=velocity)

    limits = st.builds(limit, span, strength, strength)
    dynamics = st.builds(Dynamics, damping=strength, friction=_maybe(strength))
    directions = st.sampled_from([(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.8, 0.0)])
    return st.builds(Axis, xyz=directions, limit=limits, dynamics=_maybe(dynamics))


def _movements(
    *, types: tuple[JointType, ...] | None = None, with_none: bool = False
) -> st.SearchStrategy[dict[str, Any]]:
    """Draw the type and axes of a joint of SDF; with `with_none` also an empty dictionary, for no joint."""
    axis, pitch = _axes(), numbers(min_value=0.1, max_value=3)
    one, two = {"axis": axis}, {"axis": axis, "axis2": axis}
    fields: dict[str, dict[str, st.SearchStrategy[Any]]] = {
        **dict.fromkeys(("revolute", "continuous", "prismatic"), one),
        **dict.fromkeys(("universal", "revolute2"), two),
        "screw": {**one, "screw_thread_pitch": _maybe(pitch)},
        "fixed": {},
        "ball": {},
    }
    unknown = set(types or ()) - set(fields)
    if unknown:
        raise ValueError(f"no strategy for the joints {sorted(unknown)} in SDF")
    chosen = [kind for kind in fields if types is None or kind in types]
    kinds = [st.fixed_dictionaries({"type": st.just(kind), **fields[kind]}) for kind in chosen]
    nothing: dict[str, Any] = {}
    return st.one_of(*([st.just(nothing)] if with_none else []), *kinds)


def joints(
    *,
    format: Format | str = Format.URDF,
    name: str = "joint",
    parent: str = "parent",
    child: str = "child",
    types: tuple[JointType, ...] | None = None,
) -> st.SearchStrategy[Joint]:
    """Draw joints of a name between two links, of the `types` or of all types that the format has."""

    def urdf(kind: Any, pose: Pose | None, axis: Axis) -> Joint:
        return _urdf_joint(name, kind, parent, child, pose, axis)

    def sdf(movement: dict[str, Any], pose: Pose) -> Joint:
        return Joint(name=name, parent=parent, child=child, pose=pose, **movement)

    if Format(format) is Format.URDF:
        unknown = set(types or ()) - set(URDF_TYPES)
        if unknown:
            raise ValueError(f"no strategy for the joints {sorted(unknown)} in URDF")
        return st.builds(urdf, st.sampled_from(types or URDF_TYPES), _maybe(poses()), _axes())
    return st.builds(sdf, _movements(types=types), poses(whole=True))


URDF_SHAPES = (Box, Cylinder, Sphere, Mesh)
SDF_SHAPES = (*URDF_SHAPES, Capsule, Ellipsoid)


def inertials(*, whole: bool = False) -> st.SearchStrategy[Inertial]:
    """Draw masses with the inertia of a box, which is physically possible."""

    def build(pose: Pose | None, mass: float, size: tuple[float, float, float]) -> Inertial:
        x, y, z = (side * side * mass / 12 for side in size)
        inertia = Inertia(ixx=y + z, ixy=0.0, ixz=0.0, iyy=x + z, iyz=0.0, izz=x + y)
        return Inertial(pose=pose, mass=mass, inertia=inertia)

    sizes = vectors(min_value=0.05, max_value=2)
    return st.builds(build, _maybe(poses(whole=whole)), numbers(min_value=0.1, max_value=50), sizes)


def geometries(*, shapes: tuple[type[Any], ...] = URDF_SHAPES) -> st.SearchStrategy[Geometry]:
    """Draw one of the shapes, with all its sizes written."""
    size = numbers(min_value=0.001, max_value=10)
    sizes = vectors(min_value=0.001, max_value=10)
    fields: dict[type[Any], st.SearchStrategy[Shape]] = {
        Box: st.builds(Box, size=sizes),
        Cylinder: st.builds(Cylinder, radius=size, length=size),
        Sphere: st.builds(Sphere, radius=size),
        Capsule: st.builds(Capsule, radius=size, length=size),
        Ellipsoid: st.builds(Ellipsoid, radii=sizes),
        Cone: st.builds(Cone, radius=size, length=size),
        Polyline: _polylines(size),
        Mesh: st.builds(Mesh, uri=st.sampled_from(["package://p/m.stl", "mesh.dae"]), scale=_maybe(sizes)),
    }
    unknown = set(shapes) - set(fields)
    if unknown:
        raise ValueError(f"no strategy for the shapes {sorted(shape.__name__ for shape in unknown)}")
    return st.builds(Geometry, shape=st.one_of([fields[shape] for shape in shapes]))


def _polylines(size: st.SearchStrategy[float]) -> st.SearchStrategy[Polyline]:
    """Draw outlines around the origin, in which every point is seen from there."""

    def build(distances: list[float], height: float) -> Polyline:
        turns = [2 * math.pi * each / len(distances) for each in range(len(distances))]
        points = [(r * math.cos(turn), r * math.sin(turn)) for r, turn in zip(distances, turns, strict=True)]
        elements = [Element(name="point", text=f"{x:.6g} {y:.6g}") for x, y in points]
        return Polyline(height=height, opaque=tuple(Opaque(element=each) for each in elements))

    return st.builds(build, st.lists(numbers(min_value=0.5, max_value=2), min_size=3, max_size=8), size)


def _bodies(format: Format, shapes: tuple[type[Any], ...] | None = None) -> st.SearchStrategy[dict[str, Any]]:
    """Draw the fields of a link besides its name and pose."""
    return _urdf_bodies(shapes or URDF_SHAPES) if format is Format.URDF else _sdf_bodies(shapes or SDF_SHAPES)


def _urdf_bodies(shapes: tuple[type[Any], ...]) -> st.SearchStrategy[dict[str, Any]]:
    shape = {"pose": _maybe(poses()), "geometry": geometries(shapes=shapes)}
    color = st.tuples(*[numbers(min_value=0, max_value=1)] * 4)
    material = st.builds(Material, name=st.sampled_from(["red", "blue"]), color=color)
    return st.fixed_dictionaries(
        {
            "inertial": _maybe(inertials()),
            "visuals": st.lists(st.builds(Visual, **shape, material=_maybe(material)), max_size=2).map(tuple),
            "collisions": st.lists(st.builds(Collision, **shape), max_size=1).map(tuple),
        }
    )


def _sdf_bodies(shapes: tuple[type[Any], ...]) -> st.SearchStrategy[dict[str, Any]]:
    shape = {"pose": _maybe(poses(whole=True)), "geometry": geometries(shapes=shapes)}
    return st.fixed_dictionaries(
        {
            "inertial": _maybe(inertials(whole=True)),
            "gravity": _maybe(st.booleans()),
            "visuals": st.lists(st.builds(Visual, **shape), max_size=2).map(_name_shapes("visual")),
            "collisions": st.lists(st.builds(Collision, **shape), max_size=2).map(_name_shapes("collision")),
        }
    )


def _name_shapes(kind: str) -> Any:
    def name(shapes: list[Any]) -> tuple[Any, ...]:
        return tuple(one.copy(name=f"{kind}_{number}") for number, one in enumerate(shapes))

    return name


def links(*, format: Format | str = Format.URDF, name: str = "link") -> st.SearchStrategy[Link]:
    """Draw links of a name, with or without mass and shapes, that are valid in the format."""
    return _bodies(Format(format)).map(lambda body: Link(name=name, **body))


_MOST = 1000
_PRESENT = 7
"""How many segments are drawn for each that is absent."""
_OLDEST_WITH_FRAMES = "1.8"
"""The oldest version of SDF with the syntax of frames that these models use."""


def robots(
    *,
    min_links: int = 1,
    max_links: int = 8,
    joint_types: tuple[str, ...] = URDF_TYPES,
    shapes: tuple[type[Any], ...] | None = None,
    version: UrdfVersion = "1.0",
) -> st.SearchStrategy[Document]:
    """Draw URDF documents: a tree of links with joints of every type but planar, as the front end reads them.

    Those of 1.1 have quaternions and capsules too, those of 1.2 its limits.
    """
    _require(min_links, max_links)
    shapes = shapes or (URDF_SHAPES if version == "1.0" else (*URDF_SHAPES, Capsule))
    segment = st.tuples(
        _bodies(Format.URDF, shapes), st.sampled_from(joint_types), _maybe(poses()), _axes(), st.integers(0, _MOST)
    )
    return _segments(segment, min_links, max_links).map(lambda segments: _robot(segments, version))


def _require(least: int, most: int) -> None:
    if not 1 <= least <= most <= _MOST:
        raise ValueError(f"from {least} to {most} links: a model has at least one, and at most {_MOST}")


def _segments(segment: st.SearchStrategy[Any], least: int, most: int) -> st.SearchStrategy[list[Any]]:
    """Draw a list of segments, from `least` to `most` of them."""
    needed = st.lists(segment, min_size=least, max_size=least)
    # Hypothesis cannot delete an element of more than five choices from the middle of a list, and a
    # segment has nineteen. It can make one absent, which is one choice, and delete that. Without
    # this, one of thirty failures kept a link that had nothing to do with it.
    others = st.lists(st.one_of(st.none(), *[segment] * _PRESENT), max_size=most - least)

    def present(parts: tuple[list[Any], list[Any]]) -> list[Any]:
        return [*parts[0], *(each for each in parts[1] if each is not None)]

    return st.tuples(needed, others).map(present)


def _robot(segments: list[tuple[dict[str, Any], Any, Pose | None, Axis, int]], version: UrdfVersion) -> Document:
    links: list[Link] = []
    joints: list[Joint] = []
    for number, (body, kind, pose, axis, pick) in enumerate(segments):
        placed = Pose(relative_to=f"joint_{number}") if number else None
        links.append(Link(name=f"link_{number}", pose=placed, **body))
        if number:
            parent, child = f"link_{pick % number}", f"link_{number}"
            # the number that picks the parent also picks the words of newer versions
            origin = _TURNED if version != "1.0" and pick % 3 else pose
            moving = axis.copy(limit=_newer(axis.limit, pick)) if version == "1.2" else axis
            joints.append(_urdf_joint(f"joint_{number}", kind, parent, child, origin, moving))
    model = Model(name="robot", links=tuple(links), joints=tuple(joints))
    return Document(format=Format.URDF, version=None if version == "1.0" else version, models=(model,))


_TURNED = Pose(xyz=(0.0, 0.5, 1.0), quat_xyzw=(0.0, 0.6, 0.0, 0.8))


def _newer(limit: Limit | None, pick: int) -> Limit | None:
    """A limit as URDF 1.2 may have it: without effort and velocity, and with others."""
    if limit is None or pick % 2:
        return limit
    return limit.copy(effort=None, velocity=None, acceleration=float(pick), jerk=None if pick % 4 else 0.5)


def _urdf_joint(name: str, kind: JointType, parent: str, child: str, pose: Pose | None, axis: Axis) -> Joint:
    origin = (pose or Pose()).copy(relative_to=parent)
    moving = None if kind in _NOT_MOVING else axis
    return Joint(name=name, type=kind, parent=parent, child=child, pose=origin, axis=moving)


def sdf_models(
    *,
    version: str = "1.11",
    min_links: int = 1,
    max_links: int = 8,
    joint_types: tuple[Any, ...] | None = None,
    shapes: tuple[type[Any], ...] = SDF_SHAPES,
) -> st.SearchStrategy[Document]:
    """Draw SDF documents of 1.8 or newer: a model whose links, joints and frames are posed relative to one another."""
    models = _models(version, min_links, max_links, joint_types, shapes)
    return models.map(lambda model: Document(format=Format.SDF, version=version, models=(model,)))


def worlds(
    *,
    version: str = "1.11",
    max_models: int = 3,
    max_links: int = 4,
    nested: bool = False,
    anchored: bool = False,
    shapes: tuple[type[Any], ...] = SDF_SHAPES,
) -> st.SearchStrategy[Document]:
    """Draw SDF documents of 1.8 or newer with a world, whose models are posed in it and relative to one another.

    With `nested`, a model may be static, be placed by one of its frames, and contain another model. With `anchored`, a
    joint may attach a model to the world.
    """
    models = _models(version, 1, max_links, None, shapes)
    models = _anchor_some(models) if anchored else models
    models = _nest_some(models) if nested else models
    placed = st.tuples(models, _maybe(poses(whole=True)), st.integers(0, _MOST))

    def world(parts: list[tuple[Model, Pose | None, int]]) -> Document:
        models: list[Model] = []
        for number, (model, pose, pick) in enumerate(parts):
            base = f"model_{pick % number}" if number and pick % 2 else None
            where = pose.copy(relative_to=base) if pose else None
            models.append(model.copy(name=f"model_{number}", pose=where))
        return Document(format=Format.SDF, version=version, worlds=(World(name="arena", models=tuple(models)),))

    return st.lists(placed, max_size=max_models).map(world)


def _anchor_some(models: st.SearchStrategy[Model]) -> st.SearchStrategy[Model]:
    """Attach some models to the world by a joint of any type, with or without a pose."""

    def anchor(model: Model, movement: dict[str, Any] | None, pose: Pose | None) -> Model:
        if not movement:
            return model
        joint = Joint(name="anchor", parent="world", child=model.links[0].name, pose=pose, **movement)
        return model.copy(joints=(*model.joints, joint))

    return st.builds(anchor, models, _movements(with_none=True), _maybe(poses(whole=True)))


def _nest_some(models: st.SearchStrategy[Model]) -> st.SearchStrategy[Model]:
    """Make some models static, place some by one of their frames, and put a model into some."""

    def vary(model: Model, inner: Model | None, static: bool | None, framed: bool) -> Model:
        placement = model.frames[0].name if framed and model.frames else None
        inside = (inner.copy(name="inner"),) if inner else ()
        return model.copy(models=inside, static=static, placement_frame=placement)

    return st.builds(vary, models, _maybe(models), _maybe(st.booleans()), st.booleans())


def _models(
    version: str, least: int, most: int, types: tuple[Any, ...] | None, shapes: tuple[type[Any], ...]
) -> st.SearchStrategy[Model]:
    _require(least, most)
    if tuple(map(int, version.split("."))) < tuple(map(int, _OLDEST_WITH_FRAMES.split("."))):
        raise ValueError(f"SDF {version} has other syntax for frames; these models need {_OLDEST_WITH_FRAMES} or newer")
    pose = poses(whole=True)
    movement = _movements(types=types, with_none=True)
    segment = st.tuples(_bodies(Format.SDF, shapes), movement, pose, pose, st.integers(0, _MOST), st.booleans())
    return _segments(segment, least, most).map(_sdf_model)


def _sdf_model(segments: list[Any]) -> Model:
    links: list[Link] = []
    joints: list[Joint] = []
    frames: list[Frame] = []
    for number, (body, movement, pose, frame_pose, pick, framed) in enumerate(segments):
        parent = f"link_{pick % number}" if number else None
        placed = pose.copy(relative_to=parent)
        links.append(Link(name=f"link_{number}", pose=placed, **body))
        if framed:
            frames.append(Frame(name=f"frame_{number}", attached_to=f"link_{number}", pose=frame_pose))
        if number and movement:
            child = f"link_{number}"
            joints.append(Joint(name=f"joint_{number}", parent=parent, child=child, pose=frame_pose, **movement))
    return Model(name="model", links=tuple(links), joints=tuple(joints), frames=tuple(frames))
