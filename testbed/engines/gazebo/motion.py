"""How two simulations move from the same state, compared link by link and joint by joint."""

from collections.abc import Iterator

import numpy as np

from testbed.engines.gazebo.differing import LEAST, MOVED, Difference, apart, pose_apart, short
from testbed.engines.gazebo.results import Moment, Numbers, Simulation


def motion_differences(reference: Simulation, result: Simulation, most: float) -> Iterator[Difference]:
    """Whether they come to be apart by more than this share of how far they move, from the same state.

    Of links it counts how they move, not where their frames are.
    """
    gap = max((*_joint_gaps(reference.moments[-1], result.moments[-1]), *_link_gaps(reference, result)), default=0.0)
    moved = max((*_joint_gaps(reference.moments[-1], reference.moments[0]), *_ways(reference)), default=0.0)
    if not gap <= most * max(moved, LEAST / MOVED):
        yield Difference("motion", "", f"{gap:.1e} apart after {moved:.1e}")


def _joint_gaps(one: Moment, other: Moment) -> Iterator[float]:
    """How far the joints of two moments are apart, where they have as many degrees of freedom."""
    there = {short(name): values for name, values in other.positions.items()}
    for name, values in one.positions.items():
        if len(values) == len(found := there.get(short(name), ())):
            yield apart(np.array(values), np.array(found))


def _ways(simulation: Simulation) -> Iterator[float]:
    """How far links move."""
    first, last = (simulation.moments[i].links for i in (0, -1))
    for name, state in last.items():
        yield from pose_apart(state.pose, first[name].pose)


def _link_gaps(reference: Simulation, result: Simulation) -> Iterator[float]:
    """How far links end from where they would be if they moved as in the result."""
    first, last = (reference.moments[i].links for i in (0, -1))
    starts, ends = ({short(name): state.pose for name, state in result.moments[i].links.items()} for i in (0, -1))
    for name, state in last.items():
        if short(name) in ends:
            there = _carried(first[name].pose, starts[short(name)], ends[short(name)])
            yield from pose_apart(state.pose, there)


def _carried(pose: Numbers, start: Numbers, end: Numbers) -> Numbers:
    """Where a pose comes to be with a body that moves from one pose to another, whatever the frame of the body is."""
    turn = _times(end[3:], (start[3], *(-part for part in start[4:])))
    along = np.subtract(pose[:3], start[:3])
    turned = _times(_times(turn, (0.0, *along)), (turn[0], *(-part for part in turn[1:])))
    return (*np.add(end[:3], turned[1:]).tolist(), *_times(turn, pose[3:]))


def _times(one: Numbers, other: Numbers) -> Numbers:
    """The product of two quaternions, real parts first."""
    a, b = np.array(one), np.array(other)
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return (float(a[0] * b[0] - a[1:] @ b[1:]), *vector.tolist())
