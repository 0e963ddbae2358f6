"""Axes, and joints between two links."""

from typing import Any

from hypothesis import strategies as st

from twinform.ir import Axis, Dynamics, Format, Joint, JointType, Limit, Pose
from twinform.testing.strategies._values import maybe, numbers, poses

URDF_TYPES: tuple[JointType, ...] = ("fixed", "revolute", "continuous", "prismatic", "floating")
NOT_MOVING = frozenset({"fixed", "floating"})


def axes() -> st.SearchStrategy[Axis]:
    """Axes with limits, and perhaps with damping and friction."""
    span = st.tuples(numbers(min_value=-3, max_value=0), numbers(min_value=0, max_value=3))
    strength = numbers(min_value=0, max_value=100)

    def limit(ends: tuple[float, float], effort: float, velocity: float) -> Limit:
        return Limit(lower=ends[0], upper=ends[1], effort=effort, velocity=velocity)

    limits = st.builds(limit, span, strength, strength)
    dynamics = st.builds(Dynamics, damping=strength, friction=maybe(strength))
    directions = st.sampled_from([(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.8, 0.0)])
    return st.builds(Axis, xyz=directions, limit=limits, dynamics=maybe(dynamics))


def movements(
    *, types: tuple[JointType, ...] | None = None, with_none: bool = False
) -> st.SearchStrategy[dict[str, Any]]:
    """The axis elements of a joint of SDF; nothing at all where there is none."""
    axis, pitch = axes(), numbers(min_value=0.1, max_value=3)
    one, two = {"axis": axis}, {"axis": axis, "axis2": axis}
    fields: dict[str, dict[str, st.SearchStrategy[Any]]] = {
        **dict.fromkeys(("revolute", "continuous", "prismatic"), one),
        **dict.fromkeys(("universal", "revolute2"), two),
        "screw": {**one, "screw_thread_pitch": maybe(pitch)},
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
    """Joints of a name between two links; `types` are all that the format has unless some are named."""

    def urdf(kind: Any, pose: Pose | None, axis: Axis) -> Joint:
        origin = (pose or Pose()).copy(relative_to=parent)
        moving = None if kind in NOT_MOVING else axis
        return Joint(name=name, type=kind, parent=parent, child=child, pose=origin, axis=moving)

    def sdf(movement: dict[str, Any], pose: Pose) -> Joint:
        return Joint(name=name, parent=parent, child=child, pose=pose, **movement)

    if Format(format) is Format.URDF:
        unknown = set(types or ()) - set(URDF_TYPES)
        if unknown:
            raise ValueError(f"no strategy for the joints {sorted(unknown)} in URDF")
        return st.builds(urdf, st.sampled_from(types or URDF_TYPES), maybe(poses()), axes())
    return st.builds(sdf, movements(types=types), poses(whole=True))
