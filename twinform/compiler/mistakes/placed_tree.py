"""The links of a robot of URDF as they stand with all joints at zero, and what hangs from each."""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from twinform.dataclass import dataclass
from twinform.ir import Format, Joint, Link, Model, Vector3
from twinform.ir.defaults import direction
from twinform.ir.motion import unit
from twinform.ir.transform import Transform

_UP: Vector3 = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class PlacedTree:
    """The links with their frames in that of the root, parents first, and the joints below each."""

    links: Mapping[str, Link]
    below: Mapping[str, Sequence[Joint]]
    frames: Mapping[str, Transform]

    @classmethod
    def of(cls, model: Model) -> "PlacedTree":
        """Place all links that hang from a root."""
        links = {link.name: link for link in model.links}
        below: defaultdict[str, list[Joint]] = defaultdict(list)
        for joint in model.joints:
            if joint.parent in links and joint.child in links:
                below[joint.parent].append(joint)
        held = {joint.child for joints in below.values() for joint in joints}
        frames = {name: Transform() for name in links if name not in held}
        order = list(frames)
        for name in order:  # grows while it is walked
            for joint in below[name]:
                if joint.child and joint.child not in frames:
                    frames[joint.child] = frames[name].compose(Transform.from_pose(joint.pose))
                    order.append(joint.child)
        return cls(links, below, frames)

    def axis(self, joint: Joint) -> Vector3:
        """Return the axis of a joint as a unit vector."""
        along = direction(joint.axis, Format.URDF) if joint.axis else _UP
        return unit(self.frames[joint.child or ""].rotate(along))

    def order_below(self, root: str) -> list[str]:
        """Return a link and those below it; what hangs from each stands together, behind it."""
        order: list[str] = []
        pending = [root]
        while pending:
            name = pending.pop()
            order.append(name)
            pending += [each.child or "" for each in self.below.get(name, ())]
        return order

    def mass_points(self, names: Sequence[str]) -> Iterator[tuple[float, Vector3]]:
        """Yield the masses of links and where their centers are."""
        for name in names:
            mass, center = mass_of(self.links[name])
            yield mass, self.frames[name].apply(center)


def mass_of(link: Link) -> tuple[float, Vector3]:
    """Return the mass of a link and where its center is in the link; no mass where none is written."""
    inertial = link.inertial
    if inertial is None or not inertial.mass or not 0 < inertial.mass < math.inf:
        return 0.0, (0.0, 0.0, 0.0)
    return inertial.mass, Transform.from_pose(inertial.pose).translation
