"""Whether two files are the same robot in Gazebo's physics: what one engine has of each, compared."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twinform.testing.oracles.gazebo.results import InsideJoint, Joint, Moment, Numbers, Simulation

Vector = NDArray[np.float64]

AT_REST = 1e-8
"""How far poses at rest may be apart, in m and in components of quaternions and directions."""
MOVED = 1e-5
"""How far apart motions may be, as a share of the motion."""
LEAST = 1e-9
"""Motions and masses below it, in m, rad and kg, are rounding."""
ENDLESS = 1e15
"""From here on a limit is none: libsdformat writes 1e16 where there is none."""
_PROPERTIES = ("lower", "upper", "effort", "velocity", "damping", "friction", "stiffness", "rest")


@dataclass(frozen=True, slots=True)
class Difference:
    """Something that one file has otherwise in the engine; `what` names the kind of it, `where` the part."""

    what: str
    where: str = ""
    values: str = ""

    def __str__(self) -> str:
        """In a line."""
        return " ".join(part for part in (self.what, self.where, self.values) if part)


@dataclass(frozen=True, slots=True)
class Tolerances:
    """How exact an engine is; Bullet in Debian has single precision, and moves joints that are stiff, not ideal."""

    at_rest: float = AT_REST
    moved: float | None = MOVED
    """None where motions are not compared."""


def differences(
    reference: Simulation, result: Simulation, tolerances: Tolerances, *, frames: bool = True
) -> Iterator[Difference]:
    """What differs in the result. Links and joints are known by their names without that of their model.

    Fixed joints and the links on them may be there or not: libsdformat lumps them. Without `frames`, where link frames
    are is not compared, only how links and joints move.
    """
    if not result.done:
        yield Difference("does not load", "", f"{result.outcome} at {result.stage}: {_reasons(result)}")
        return
    yield from _new_lines(reference, result)
    yield from _joints(reference, result, tolerances)
    if frames:
        yield from _rest(reference.moments[0], result.moments[0], tolerances)
    yield from _mass(reference, result)
    if tolerances.moved is not None:
        yield from _motion(reference, result, tolerances.moved, frames=frames)


def _reasons(simulation: Simulation) -> str:
    return "; ".join((*simulation.errors, *simulation.console.errors, *simulation.console.other[-2:]))


def _new_lines(reference: Simulation, result: Simulation) -> Iterator[Difference]:
    for kind, before, now in (
        ("new error line", reference.console.errors, result.console.errors),
        ("new warning line", reference.console.warnings, result.console.warnings),
    ):
        yield from (Difference(kind, "", line) for line in dict.fromkeys(now) if line not in before)


def short(name: str) -> str:
    """The name of a part without that of the model that it is in."""
    return name.partition("::")[2] or name


def _by_short_name(simulation: Simulation) -> dict[str, Joint]:
    return {short(name): joint for name, joint in simulation.joint.items() if joint.freedom != 0}


def _joints(reference: Simulation, result: Simulation, tolerances: Tolerances) -> Iterator[Difference]:
    """Joints that move, or that did not come to be there."""
    before, now = _by_short_name(reference), _by_short_name(result)
    places = _origins(reference), _origins(result)
    for name in dict.fromkeys((*before, *now)):
        one, other = before.get(name), now.get(name)
        freedoms = tuple(joint.freedom if joint else "no joint" for joint in (one, other))
        if one is None or other is None or one.freedom != other.freedom:
            yield Difference("degrees of freedom", name, f"{freedoms[0]} became {freedoms[1]}")
        elif one.inside and other.inside:
            yield from _inside(name, one.inside, other.inside)
            screws = _screws(one, places[0]), _screws(other, places[1])
            if (apart := _apart(*screws)) > tolerances.at_rest:
                yield Difference("axis", name, f"{apart:.1e} apart")


def _origins(simulation: Simulation) -> Mapping[str, Vector]:
    return {name: np.array(state.pose[:3]) for name, state in simulation.moments[0].links.items()}


def _screws(joint: Joint, origins: Mapping[str, Vector]) -> Vector:
    """The screws of a joint about the origin of the world, whatever the frame of its child is."""
    inside = joint.inside
    rows = np.array(inside.screws if inside else (), dtype=float).reshape(-1, 6)
    return np.hstack((rows[:, :3], rows[:, 3:] - np.cross(rows[:, :3], origins[joint.child])))


def _apart(one: Vector, other: Vector) -> float:
    return float(np.max(np.abs(one - other), initial=0.0)) if one.shape == other.shape else np.inf


def _inside(name: str, one: InsideJoint, other: InsideJoint) -> Iterator[Difference]:
    for each in _PROPERTIES:
        before: Numbers = getattr(one, each)
        now: Numbers = getattr(other, each)
        if not np.allclose(_ended(before), _ended(now), rtol=1e-9, atol=1e-12):
            yield Difference(each, name, f"{_numbers(before)} became {_numbers(now)}")


def _ended(values: Numbers) -> Vector:
    """Limits, with those that are none as infinity."""
    return np.array([np.copysign(np.inf, value) if abs(value) >= ENDLESS else value for value in values])


def _numbers(values: Numbers) -> str:
    return ", ".join(f"{value:.6g}" for value in values)


def _rest(reference: Moment, result: Moment, tolerances: Tolerances) -> Iterator[Difference]:
    now = {short(name): state for name, state in result.links.items()}
    for name, state in reference.links.items():
        if short(name) not in now:
            yield Difference("link is missing", short(name))
        elif (apart := max(_pose_apart(state.pose, now[short(name)].pose))) > tolerances.at_rest:
            yield Difference("pose at rest", short(name), f"{apart:.1e} apart")


def _pose_apart(one: Numbers, other: Numbers) -> tuple[float, float]:
    """How far positions are apart in m, and orientations in rad."""
    along = float(np.linalg.norm(np.subtract(one[:3], other[:3])))
    first, second = np.array(one[3:]), np.array(other[3:])
    chord = min(np.linalg.norm(first - second), np.linalg.norm(first + second))
    return along, 4.0 * float(np.arcsin(min(1.0, chord / 2.0)))


def _masses(simulation: Simulation) -> float | None:
    masses = [link.mass for link in simulation.links if link.mass is not None]
    return sum(masses) if masses else None


def _mass(reference: Simulation, result: Simulation) -> Iterator[Difference]:
    before, now = _masses(reference), _masses(result)
    if before is not None and now is not None and abs(before - now) > LEAST + AT_REST * before:
        yield Difference("mass", "", f"{before:.6g} became {now:.6g}")


def _motion(reference: Simulation, result: Simulation, most: float, *, frames: bool) -> Iterator[Difference]:
    """How far apart they come to be from the same state, as a share of how far they move."""
    first, last = reference.moments[0], reference.moments[-1]
    joints = {short(name): values for name, values in result.moments[-1].positions.items()}
    apart, moved = 0.0, LEAST / MOVED
    for name, values in last.positions.items():
        now = joints.get(short(name), ())
        if len(values) == len(now):
            apart = max(apart, _apart(np.array(values), np.array(now)))
            moved = max(moved, _apart(np.array(values), np.array(first.positions[name])))
    links = {short(name): state for name, state in result.moments[-1].links.items()} if frames else {}
    for name, state in last.links.items():
        moved = max(moved, *_pose_apart(state.pose, first.links[name].pose))
        if short(name) in links:
            apart = max(apart, *_pose_apart(state.pose, links[short(name)].pose))
    if not apart <= most * moved:
        yield Difference("motion", "", f"{apart:.1e} apart after {moved:.1e}")
