"""How far each link can be from the root that it hangs from."""

import math
from typing import NamedTuple

from twinform.compiler.scene import Scene, SceneJoint
from twinform.ir.motion import spanning_tree


class Reach(NamedTuple):
    """A link, and the distances of its frame from that of its root in m: at zero, and if every joint were stretched.

    `most` is a bound that turning joints may never reach; it is infinite where a joint slides without an end.
    """

    link: str
    zero: float
    most: float


def reaches(scene: Scene) -> tuple[Reach, ...]:
    """All links that hang from others, in the order of the file."""
    tree = spanning_tree(scene.joints)
    frames = {link.name: link.pose for link in scene.links}
    known: dict[str, tuple[str, float]] = {}
    for start in frames:
        path: list[str] = []
        name = start
        while name in tree and name not in known and tree[name].parent in frames:
            path.append(name)
            name = tree[name].parent
        root, far = known.get(name, (name, 0.0))
        known.setdefault(name, (root, far))
        for each in reversed(path):
            joint = tree[each]
            far += math.dist(frames[joint.parent].translation, frames[each].translation) + _travel(joint)
            known[each] = root, far
    return tuple(
        Reach(name, math.dist(frame.translation, frames[known[name][0]].translation), known[name][1])
        for name, frame in frames.items()
        if known[name][0] != name
    )


def _travel(joint: SceneJoint) -> float:
    """The furthest that a joint can slide from where it is at zero."""
    return sum(max(abs(degree.lower), abs(degree.upper)) for degree in joint.degrees if degree.slides or degree.pitch)
