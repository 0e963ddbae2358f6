"""Lumped links: links of one file that the other has merged into the link that they are fixed to.

libsdformat does so with every fixed joint of URDF. Nothing of the robot changes by it: mass and inertia add up, and
what the link shows and touches with stays where it is.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView, Mass, NamedFrame
from twinform.ir.motion import spanning_tree
from twinform.ir.solids import combined

_EVIDENCE = 1e-5
"""How well the masses must agree to believe that a link went into another; the comparison itself is exact."""


@dataclass(frozen=True, slots=True)
class Lumped:
    """Two robots with the same links, as far as that can be; `into` are the links that went into others by name."""

    a: ComparedRobot
    b: ComparedRobot
    from_a: Mapping[str, str]
    from_b: Mapping[str, str]


def lump(a: ComparedRobot, b: ComparedRobot) -> Lumped:
    """Both robots after links that only one of them has went into those that they are fixed to."""
    groups_a, groups_b = _groups(a, b), _groups(b, a)
    into_a: dict[str, str] = {}
    into_b: dict[str, str] = {}
    for name in sorted(groups_a.keys() | groups_b.keys()):
        mine, theirs = groups_a.get(name, []), groups_b.get(name, [])
        if _is_one_body(a, b, name, mine, theirs):
            into_a |= dict.fromkeys(mine, name)
            into_b |= dict.fromkeys(theirs, name)
    return Lumped(_lumped(a, into_a), _lumped(b, into_b), into_a, into_b)


def _groups(robot: ComparedRobot, other: ComparedRobot) -> dict[str, list[str]]:
    """The links that the other robot does not have, by the nearest link above that both have."""
    hung, found = spanning_tree(robot.joints.values()), defaultdict[str, list[str]](list)
    for name in robot.bodies:
        above = name
        while above not in other.bodies and above in hung and hung[above].type == "fixed":
            above = hung[above].parent
        if above != name and above in other.bodies:
            found[above].append(name)
    return found


def _is_one_body(a: ComparedRobot, b: ComparedRobot, name: str, mine: list[str], theirs: list[str]) -> bool:
    """Whether the masses say so; of links without mass, only a frame of the same name can tell.

    Where each of the robots has links that the other lacks, they may as well be called otherwise.
    """
    if mine and theirs:
        return False
    total_a, total_b = _total(a, (name, *mine)), _total(b, (name, *theirs))
    if abs(total_a - total_b) > _EVIDENCE * max(total_a, total_b):
        return False
    # A massless link leaves no trace in the masses. libsdformat 12 leaves no frame behind either,
    # so such a link is missing without being an error, unless a frame of its name exists.
    heavy = _total(a, mine) + _total(b, theirs) > 0
    return heavy or (all(each in b.frames for each in mine) and all(each in a.frames for each in theirs))


def _total(robot: ComparedRobot, names: Iterable[str]) -> float:
    return sum(robot.bodies[name].mass.solid.mass for name in names)


def _lumped(robot: ComparedRobot, into: Mapping[str, str]) -> ComparedRobot:
    if not into:
        return robot
    hung, guests = spanning_tree(robot.joints.values()), defaultdict[str, list[ComparedBody]](list)
    for name, host in into.items():
        guests[host].append(robot.bodies[name])
    bodies = {
        name: _host(body, guests[name]) if name in guests else body
        for name, body in robot.bodies.items()
        if name not in into
    }
    gone = {hung[name].name for name in into}
    joints = {name: _connected(joint, into) for name, joint in robot.joints.items() if name not in gone}
    frames = {name: _attached(frame, into) for name, frame in robot.frames.items()}
    for name, host in into.items():
        joint, body = hung[name], robot.bodies[name]
        frames[joint.name] = NamedFrame(joint.name, host, joint.frame, lumped=True, where=joint.where)
        frames[name] = NamedFrame(name, host, body.frame, lumped=True, where=body.where)
    return replace(robot, bodies=bodies, joints=joints, frames=frames)


def _connected(joint: JointView, into: Mapping[str, str]) -> JointView:
    return replace(joint, parent=into.get(joint.parent, joint.parent), child=into.get(joint.child, joint.child))


def _attached(frame: NamedFrame, into: Mapping[str, str]) -> NamedFrame:
    return replace(frame, body=into[frame.body]) if frame.body in into else frame


def _host(body: ComparedBody, guests: list[ComparedBody]) -> ComparedBody:
    parts = (*body.parts, *(part for guest in guests for part in guest.parts))
    return replace(body, parts=parts, mass=together([body.mass, *(guest.mass for guest in guests)]))


def together(masses: list[Mass]) -> Mass:
    """The mass of bodies that move as one."""
    heavy = [each.solid for each in masses if each.solid.mass]
    if not heavy:
        return masses[0]
    return Mass(combined(heavy), any(each.automatic for each in masses), masses[0].where)
