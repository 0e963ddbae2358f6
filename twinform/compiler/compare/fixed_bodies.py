"""Links that fixed joints make into one body: how two files may share its mass, and which links one file has merged.

Two files may share the mass and inertia of a body among its links in different ways. A conversion to SDF changes the
shares where a link has an inertia that libsdformat refuses.

*Lumped* links are links of one file that the other has merged into the link that they are fixed to. libsdformat does so
with every fixed joint of URDF. The robot stays the same: masses and inertias add up, and visuals and collisions stay
where they are.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cached_property

from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView, Mass, NamedFrame
from twinform.dataclass import dataclass
from twinform.ir.groups import tops
from twinform.ir.motion import spanning_tree
from twinform.ir.solids import Solid, combined
from twinform.passes.legalise.shared_inertias import is_refused


class FixedBodies:
    """The links of one robot, grouped by the rigid body that they belong to."""

    def __init__(self, robot: ComparedRobot) -> None:
        self.robot = robot

    @cached_property
    def _hosts(self) -> dict[str, str]:
        """The topmost link of each link's body."""
        hung = spanning_tree(self.robot.joints.values())
        return tops(self.robot.bodies, {name: joint.parent for name, joint in hung.items() if joint.type == "fixed"})

    @cached_property
    def _members(self) -> dict[str, list[Solid]]:
        members = defaultdict[str, list[Solid]](list)
        for name, body in self.robot.bodies.items():
            members[self._hosts[name]].append(body.mass.solid)
        return members

    @cached_property
    def _wholes(self) -> dict[str, Solid]:
        return {host: combined(members) for host, members in self._members.items()}

    @cached_property
    def _impossible(self) -> set[str]:
        return {host for host, members in self._members.items() if any(is_refused(each.inertia) for each in members)}

    def whole(self, link: str) -> Solid:
        """Return the mass and inertia of the whole body that a link belongs to."""
        return self._wholes[self._hosts[link]]

    def is_shared(self, link: str) -> bool:
        """Whether a conversion shares the mass of a link's body: libsdformat refuses an inertia in it."""
        return self._hosts[link] in self._impossible


_EVIDENCE = 1e-5
"""How well the masses must agree to believe that a link went into another; the comparison itself is exact."""


@dataclass(frozen=True, slots=True)
class Lumped:
    """Two robots after lumping; `from_a` and `from_b` map the names of lumped links to those of the remaining ones."""

    a: ComparedRobot
    b: ComparedRobot
    from_a: Mapping[str, str]
    from_b: Mapping[str, str]


def lump(a: ComparedRobot, b: ComparedRobot) -> Lumped:
    """Merge links that only one robot has into the links that they are fixed to, where the other did so."""
    groups_a, groups_b = _links_to_merge(a, b), _links_to_merge(b, a)
    into_a: dict[str, str] = {}
    into_b: dict[str, str] = {}
    for name in sorted(groups_a.keys() | groups_b.keys()):
        mine, theirs = groups_a.get(name, []), groups_b.get(name, [])
        if _is_one_body(a, b, name, mine, theirs):
            into_a |= dict.fromkeys(mine, name)
            into_b |= dict.fromkeys(theirs, name)
    return Lumped(_merge_links(a, into_a), _merge_links(b, into_b), into_a, into_b)


def _links_to_merge(robot: ComparedRobot, other: ComparedRobot) -> dict[str, list[str]]:
    """Return the links that the other robot lacks, grouped by the nearest fixed parent that both robots have."""
    hung, found = spanning_tree(robot.joints.values()), defaultdict[str, list[str]](list)
    for name in robot.bodies:
        above = name
        while above not in other.bodies and above in hung and hung[above].type == "fixed":
            above = hung[above].parent
        if above != name and above in other.bodies:
            found[above].append(name)
    return found


def _is_one_body(a: ComparedRobot, b: ComparedRobot, name: str, mine: list[str], theirs: list[str]) -> bool:
    """Whether a link has the mass of a whole group; of links without mass, only a frame of the same name can tell.

    Where each of the robots has links that the other lacks, they may just as well have been renamed.
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


def _merge_links(robot: ComparedRobot, into: Mapping[str, str]) -> ComparedRobot:
    if not into:
        return robot
    hung, guests = spanning_tree(robot.joints.values()), defaultdict[str, list[ComparedBody]](list)
    for name, host in into.items():
        guests[host].append(robot.bodies[name])
    bodies = {
        name: _absorb(body, guests[name]) if name in guests else body
        for name, body in robot.bodies.items()
        if name not in into
    }
    gone = {hung[name].name for name in into}
    joints = {name: _reconnect(joint, into) for name, joint in robot.joints.items() if name not in gone}
    frames = {name: _reattach(frame, into) for name, frame in robot.frames.items()}
    for name, host in into.items():
        joint, body = hung[name], robot.bodies[name]
        frames[joint.name] = NamedFrame(joint.name, host, joint.frame, lumped=True, where=joint.where)
        frames[name] = NamedFrame(name, host, body.frame, lumped=True, where=body.where)
    return replace(robot, bodies=bodies, joints=joints, frames=frames)


def _reconnect(joint: JointView, into: Mapping[str, str]) -> JointView:
    return replace(joint, parent=into.get(joint.parent, joint.parent), child=into.get(joint.child, joint.child))


def _reattach(frame: NamedFrame, into: Mapping[str, str]) -> NamedFrame:
    return replace(frame, body=into[frame.body]) if frame.body in into else frame


def _absorb(body: ComparedBody, guests: list[ComparedBody]) -> ComparedBody:
    parts = (*body.parts, *(part for guest in guests for part in guest.parts))
    return replace(body, parts=parts, mass=together([body.mass, *(guest.mass for guest in guests)]))


def together(masses: list[Mass]) -> Mass:
    """Return the combined mass of bodies that move as one."""
    heavy = [each.solid for each in masses if each.solid.mass]
    if not heavy:
        return masses[0]
    return Mass(combined(heavy), any(each.automatic for each in masses), masses[0].where)
