"""Links that fixed joints make one body, which may share the mass and inertia of that body in two ways.

SDF of a URDF does so where one of them has an inertia that no body has, and a file that was edited need not.
"""

from collections import defaultdict
from functools import cached_property

from twinform.compiler.compare.compared_robot import ComparedRobot
from twinform.ir.groups import tops
from twinform.ir.motion import spanning_tree
from twinform.ir.solids import Solid, combined
from twinform.passes.legalise.shared_inertias import is_refused


class FixedBodies:
    """The links of one robot by the bodies that they are parts of."""

    def __init__(self, robot: ComparedRobot) -> None:
        self.robot = robot

    @cached_property
    def _hosts(self) -> dict[str, str]:
        """The uppermost link of the body that each link is a part of."""
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
        """What the links of the body that a link is a part of are together."""
        return self._wholes[self._hosts[link]]

    def is_shared(self, link: str) -> bool:
        """Whether SDF of a URDF shares the body of a link: one of its links has an inertia that libsdformat refuses."""
        return self._hosts[link] in self._impossible
