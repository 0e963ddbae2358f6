"""Joints of two simulations, compared: degrees of freedom, axes and properties, and chains that stand for one joint."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from testbed.engines.gazebo.differing import Difference, Tolerances, Vector, apart, short
from testbed.engines.gazebo.results import InsideJoint, Joint, Numbers, Simulation

ENDLESS = 1e15
"""From here on a limit is none: libsdformat writes 1e16 where there is none."""
_PROPERTIES = ("lower", "upper", "effort", "velocity", "damping", "friction", "stiffness", "rest")


def _by_short_name(simulation: Simulation) -> dict[str, Joint]:
    return {short(name): joint for name, joint in simulation.joint.items() if joint.freedom != 0}


def joint_differences(reference: Simulation, result: Simulation, tolerances: Tolerances) -> Iterator[Difference]:
    """Joints that move otherwise, or that did not come to be there."""
    before, now = _by_short_name(reference), _by_short_name(result)
    origins = _origins(reference), _origins(result)
    chained = chains(reference, result)
    inner = {short(joint.name) for chain in chained.values() for joint in chain} - chained.keys()
    for name in dict.fromkeys((*before, *(name for name in now if name not in inner))):
        one = [before[name]] if name in before else []
        other = chained.get(name) or ([now[name]] if name in now else [])
        if (first := _freedom(one)) != (second := _freedom(other)):
            yield Difference("degrees of freedom", name, f"{first} became {second}")
        elif all(joint.inside for joint in (*one, *other)):
            yield from _properties(name, one[0].inside, other[0].inside) if len(other) == 1 else ()
            screws = _screws(one, origins[0]), _screws(other, origins[1])
            if (gap := apart(*(map(_span, screws) if len(other) > 1 else screws))) > tolerances.at_rest:
                yield Difference("axis", name, f"{gap:.1e} apart")


def _freedom(joints: Sequence[Joint]) -> int | str:
    freedoms = [joint.freedom for joint in joints]
    if None in freedoms or not freedoms:
        return "no joint"
    return sum(each for each in freedoms if each is not None)


def chains(reference: Simulation, result: Simulation) -> dict[str, list[Joint]]:
    """Joints of the reference that are several in the result, with those, from the parent's side.

    URDF has no joints with several degrees of freedom, nor screws.
    """
    above: dict[str, Joint] = {}
    for joint in result.joints:  # the first one of a link holds it, others close a loop
        if joint.freedom is not None:
            above.setdefault(short(joint.child), joint)
    known = {short(name) for name in reference.joint}
    found: dict[str, list[Joint]] = {}
    for joint in reference.joints:
        chain: list[Joint] = []
        link = short(joint.child)
        while link != short(joint.parent) and link in above and above[link] not in chain:
            chain.insert(0, above[link])
            link = short(above[link].parent)
        names = [short(each.name) for each in chain]
        if len(chain) > 1 and link == short(joint.parent) and known.intersection(names) == {short(joint.name)}:
            found[short(joint.name)] = chain
    return found


def _origins(simulation: Simulation) -> Mapping[str, Vector]:
    return {name: np.array(state.pose[:3]) for name, state in simulation.moments[0].links.items()}


def _screws(joints: Sequence[Joint], origins: Mapping[str, Vector]) -> Vector:
    """The screws of joints about the origin of the world, whatever the frames of their children are."""
    return np.vstack([_screws_of(joint, origins) for joint in joints])


def _screws_of(joint: Joint, origins: Mapping[str, Vector]) -> Vector:
    inside = joint.inside
    rows = np.array(inside.screws if inside else (), dtype=float).reshape(-1, 6)
    return np.hstack((rows[:, :3], rows[:, 3:] - np.cross(rows[:, :3], origins[joint.child])))


def _span(screws: Vector) -> Vector:
    """What screws reach together, as a projection: the same for all that reach as far."""
    return np.linalg.pinv(screws) @ screws


def _properties(name: str, one: InsideJoint | None, other: InsideJoint | None) -> Iterator[Difference]:
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
