"""Whole files: robots of URDF, models and worlds of SDF."""

from typing import Any

from hypothesis import strategies as st

from twinform.ir import Axis, Document, Format, Frame, Joint, Link, Model, Pose, World
from twinform.testing.strategies._bodies import SDF_SHAPES, URDF_SHAPES, bodies
from twinform.testing.strategies._joints import NOT_MOVING, URDF_TYPES, axes, movements
from twinform.testing.strategies._values import maybe, poses

_MOST = 1000
_PRESENT = 7
"""To each segment that is absent."""
_OLDEST_WITH_FRAMES = "1.8"
"""The oldest version of SDF that has frames as these models do."""


def robots(
    *,
    min_links: int = 1,
    max_links: int = 8,
    joint_types: tuple[str, ...] = URDF_TYPES,
    shapes: tuple[type[Any], ...] = URDF_SHAPES,
) -> st.SearchStrategy[Document]:
    """URDF documents: a tree of links with joints of every type but planar, as the front end reads them."""
    _require(min_links, max_links)
    segment = st.tuples(
        bodies(Format.URDF, shapes), st.sampled_from(joint_types), maybe(poses()), axes(), st.integers(0, _MOST)
    )
    return _segments(segment, min_links, max_links).map(_robot)


def _require(least: int, most: int) -> None:
    if not 1 <= least <= most <= _MOST:
        raise ValueError(f"from {least} to {most} links: a model has at least one, and at most {_MOST}")


def _segments(segment: st.SearchStrategy[Any], least: int, most: int) -> st.SearchStrategy[list[Any]]:
    """So many segments at least and at most, some of the others absent.

    Hypothesis cannot delete what is longer than five choices from the middle of a list. It can make it absent, which is
    one choice, and delete that.
    """
    needed = st.lists(segment, min_size=least, max_size=least)
    # A segment has nineteen choices. Without this, one of thirty failures kept a link that had
    # nothing to do with it.
    others = st.lists(st.one_of(st.none(), *[segment] * _PRESENT), max_size=most - least)

    def present(parts: tuple[list[Any], list[Any]]) -> list[Any]:
        return [*parts[0], *(each for each in parts[1] if each is not None)]

    return st.tuples(needed, others).map(present)


def _robot(segments: list[tuple[dict[str, Any], Any, Pose | None, Axis, int]]) -> Document:
    links: list[Link] = []
    joints: list[Joint] = []
    for number, (body, kind, pose, axis, pick) in enumerate(segments):
        placed = Pose(relative_to=f"joint_{number}") if number else None
        links.append(Link(name=f"link_{number}", pose=placed, **body))
        if number:
            parent = f"link_{pick % number}"
            origin = (pose or Pose()).copy(relative_to=parent)
            joints.append(
                Joint(
                    name=f"joint_{number}",
                    type=kind,
                    parent=parent,
                    child=f"link_{number}",
                    pose=origin,
                    axis=None if kind in NOT_MOVING else axis,
                )
            )
    model = Model(name="robot", links=tuple(links), joints=tuple(joints))
    return Document(format=Format.URDF, models=(model,))


def sdf_models(
    *,
    version: str = "1.11",
    min_links: int = 1,
    max_links: int = 8,
    joint_types: tuple[Any, ...] | None = None,
    shapes: tuple[type[Any], ...] = SDF_SHAPES,
) -> st.SearchStrategy[Document]:
    """SDF documents of 1.8 or newer: a model whose links, joints and frames are posed in one another."""
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
    """SDF documents of 1.8 or newer with a world, whose models are posed in it and in one another.

    With `nested`, a model may be static, placed by one of its frames, and have another model in it. With `anchored`,
    a model may hang from the world by a joint.
    """
    models = _models(version, 1, max_links, None, shapes)
    models = _anchored(models) if anchored else models
    models = _varied(models) if nested else models
    placed = st.tuples(models, maybe(poses(whole=True)), st.integers(0, _MOST))

    def world(parts: list[tuple[Model, Pose | None, int]]) -> Document:
        models: list[Model] = []
        for number, (model, pose, pick) in enumerate(parts):
            base = f"model_{pick % number}" if number and pick % 2 else None
            where = pose.copy(relative_to=base) if pose else None
            models.append(model.copy(name=f"model_{number}", pose=where))
        return Document(format=Format.SDF, version=version, worlds=(World(name="arena", models=tuple(models)),))

    return st.lists(placed, max_size=max_models).map(world)


def _anchored(models: st.SearchStrategy[Model]) -> st.SearchStrategy[Model]:
    """The models, of which some have a joint to the world, of any type and posed in the model or not."""

    def anchor(model: Model, movement: dict[str, Any] | None, pose: Pose | None) -> Model:
        if not movement:
            return model
        joint = Joint(name="anchor", parent="world", child=model.links[0].name, pose=pose, **movement)
        return model.copy(joints=(*model.joints, joint))

    return st.builds(anchor, models, movements(with_none=True), maybe(poses(whole=True)))


def _varied(models: st.SearchStrategy[Model]) -> st.SearchStrategy[Model]:
    """The models, static or not, placed by themselves or one of their frames, with one in them or none."""

    def vary(model: Model, inner: Model | None, static: bool | None, framed: bool) -> Model:
        placement = model.frames[0].name if framed and model.frames else None
        inside = (inner.copy(name="inner"),) if inner else ()
        return model.copy(models=inside, static=static, placement_frame=placement)

    return st.builds(vary, models, maybe(models), maybe(st.booleans()), st.booleans())


def _models(
    version: str, least: int, most: int, types: tuple[Any, ...] | None, shapes: tuple[type[Any], ...]
) -> st.SearchStrategy[Model]:
    _require(least, most)
    if tuple(map(int, version.split("."))) < tuple(map(int, _OLDEST_WITH_FRAMES.split("."))):
        raise ValueError(f"SDF {version} has other syntax for frames; these models need {_OLDEST_WITH_FRAMES} or newer")
    pose = poses(whole=True)
    movement = movements(types=types, with_none=True)
    segment = st.tuples(bodies(Format.SDF, shapes), movement, pose, pose, st.integers(0, _MOST), st.booleans())
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
