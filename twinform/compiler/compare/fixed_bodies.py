"""Links that fixed joints make one body, which may share the inertia of that body in two ways.

SDF of a URDF does so where one of them has an inertia that no body has, and a file that was edited need not.
"""

import math
from collections import defaultdict
from collections.abc import Iterable
from functools import cached_property

from twinform.compiler.compare.findings import Base
from twinform.compiler.compare.robot import Body, Robot
from twinform.compiler.compare.values import Tensor
from twinform.ir.motion import spanning_tree
from twinform.ir.principal_moments import Symmetric
from twinform.ir.transform import Transform
from twinform.passes.legalise.shared_inertias import is_refused


class FixedBodies:
    """The links of one robot by the bodies that they are parts of."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot

    @cached_property
    def _hosts(self) -> dict[str, str]:
        """The uppermost link of the body that each link is a part of."""
        hung, found = spanning_tree(self.robot.joints.values()), dict[str, str]()
        for name in self.robot.bodies:
            path = [name]
            while path[-1] in hung and path[-1] not in found and hung[path[-1]].type == "fixed":
                path.append(hung[path[-1]].parent)
            host = found.get(path[-1], path[-1])
            found |= dict.fromkeys(path, host)
        return found

    @cached_property
    def _members(self) -> dict[str, list[Body]]:
        members = defaultdict[str, list[Body]](list)
        for name, body in self.robot.bodies.items():
            members[self._hosts[name]].append(body)
        return members

    def of(self, link: str) -> list[Body]:
        """The links of the body that a link is a part of."""
        return self._members[self._hosts[link]]

    def inertia(self, link: str, base: Transform) -> Symmetric:
        """The sum of the inertias of these links, each about its own center, in the axes of a frame."""
        return _sum(Tensor(each.mass.solid.inertia).seen_from(base).moments for each in self.of(link))


def with_share(inertia: Symmetric, link: str, base: Base, bodies: tuple[FixedBodies, FixedBodies]) -> Symmetric | None:
    """The inertia that a link of the first robot has in the second one, if the two share those of a body otherwise.

    Both are seen from `base`. None where they share none: no link of the body has an inertia that libsdformat refuses.
    """
    one, other = bodies
    members = (*one.of(link), *other.of(link))
    if not any(is_refused(each.mass.solid.inertia) for each in members):
        return None
    more = (b - a for a, b in zip(one.inertia(link, base.a), other.inertia(link, base.b), strict=True))
    return _sum((inertia, tuple(more)))


def _sum(parts: Iterable[Iterable[float]]) -> Symmetric:
    xx, yy, zz, xy, xz, yz = map(math.fsum, zip(*parts, strict=True))
    return xx, yy, zz, xy, xz, yz
