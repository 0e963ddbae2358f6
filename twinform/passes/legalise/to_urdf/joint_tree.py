"""A forest of joints, in which joints are reversed where a link would hang from two of them."""

from dataclasses import dataclass, field
from typing import NamedTuple

from twinform.ir import Joint
from twinform.ir.frames import WORLD
from twinform.passes.structure.reversal import REVERSIBLE, measures_in_sensor


class _Above(NamedTuple):
    """The joint that a link hangs from, and the link, or `world`, at its other end."""

    joint: Joint
    parent: str


@dataclass(slots=True)
class _Way:
    """A way from a link towards its root, as far as it was walked."""

    start: str
    end: str
    links: list[str] = field(default_factory=list[str])


class JointTree:
    """The joints that were taken in, so that each link hangs from one at most; `turned` names those to be reversed.

    All joints of a robot are taken in in linear time, but for a logarithm: of two ways that can be reversed the shorter
    one is, and the links of one that cannot be are remembered.
    """

    def __init__(self, links: list[str]) -> None:
        self.turned: set[str] = set()
        self._above: dict[str, _Above] = {}
        self._stuck = {WORLD}
        """What cannot become a root any more: there is the world, or a joint that is not reversible, above it."""
        self._group = {name: name for name in (*links, WORLD)}

    def add(self, joint: Joint) -> bool:
        """Take a joint in as it is, unless its child hangs from another one or it closes a circle."""
        parent, child = joint.parent or WORLD, joint.child or ""
        if child in self._above or self._find(parent) == self._find(child):
            return False
        self._hang(child, _Above(joint, parent))
        return True

    def join(self, joint: Joint) -> bool:
        """Take a joint in, and reverse what has to be for that; not one that closes a circle, or cannot be reversed."""
        if self.add(joint):
            return True
        parent, child = joint.parent or WORLD, joint.child or ""
        if self._find(parent) == self._find(child):
            return False
        way = self._shorter_way(child, parent if _is_reversible(joint) else WORLD)
        if way is None:
            return False
        self._reverse(way)
        if way.start == child:
            self._hang(child, _Above(joint, parent))
        else:
            self.turned ^= {joint.name}
            self._hang(parent, _Above(joint, child))
        return True

    def root(self, link: str) -> str:
        """The link, or `world`, that a link hangs from in the end."""
        while link in self._above:
            link = self._above[link].parent
        return link

    def holds_any(self, link: str) -> bool:
        """Whether something hangs from a link, or from `world`."""
        return any(above.parent == link for above in self._above.values())

    def _hang(self, link: str, above: _Above) -> None:
        self._above[link] = above
        self._group[self._find(link)] = self._find(above.parent)

    def _shorter_way(self, *links: str) -> _Way | None:
        """The way up to its root from the link that has fewer joints above it; None where none can be reversed."""
        # Both ways are walked in turns, so that the work is that of the shorter one.
        ways = [_Way(link, link) for link in links]
        while ways:
            for way in tuple(ways):
                if way.end in self._stuck:
                    self._stuck.update(way.links)
                    ways.remove(way)
                    continue
                above = self._above.get(way.end)
                if above is None:
                    return way
                way.links.append(way.end)
                way.end = above.parent if _is_reversible(above.joint) else WORLD
        return None

    def _reverse(self, way: _Way) -> None:
        """Let what the way leads to hang from where it begins."""
        joints = [self._above.pop(link) for link in way.links]
        for link, above in zip(way.links, joints, strict=True):
            self.turned ^= {above.joint.name}
            self._above[above.parent] = _Above(above.joint, link)

    def _find(self, name: str) -> str:
        group = self._group
        while group[name] != name:
            group[name] = name = group[group[name]]
        return name


def _is_reversible(joint: Joint) -> bool:
    return joint.type in REVERSIBLE and not measures_in_sensor(joint)
