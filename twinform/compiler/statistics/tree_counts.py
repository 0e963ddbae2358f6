"""Counts of the kinematic tree: roots, loops, depth."""

from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir import Joint, Model
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.groups import Groups
from twinform.ir.scopes import nested_models, scoped_models

FREEDOMS = {
    "fixed": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "screw": 1, "universal": 2, "revolute2": 2,
    "piston": 2, "planar": 3, "ball": 3, "spherical": 3, "floating": 6, "gearbox": -1,
}  # fmt: skip
"""How many ways a joint lets its child go; a gearbox takes one away from the joints that it couples."""


class TreeShape(NamedTuple):
    """`depth` is the most joints between a root and a link; `loops` are joints that no tree needs."""

    depth: int
    loops: int


def joints_of(model: Model) -> Iterator[Joint]:
    """The joints of a model and of those nested in it."""
    return (joint for each in nested_models(model) for joint in each.joints)


def freedom(joint: Joint) -> int:
    """In how many ways a joint moves by itself: an axis that follows another joint does not, nor a fixed one."""
    followed = sum(axis is not None and axis.mimic is not None for axis in (joint.axis, joint.axis2))
    return max(0, FREEDOMS[joint.type] - followed)


def shape(model: Model) -> TreeShape:
    """How deep the tree of a model is, and how many joints close loops in it."""
    parents: dict[str, str] = {}
    groups, loops = Groups(), 0
    for parent, child in _ends(model):
        if groups.join(parent, child):
            parents.setdefault(child, parent)
        else:
            loops += 1
    return TreeShape(_depth(parents), loops)


def _ends(model: Model) -> Iterator[tuple[str, str]]:
    """The links that each joint connects; a gearbox connects none."""
    graph = FrameGraph(model)
    for scope, inner in scoped_models(model):
        for joint in inner.joints:
            if joint.parent and joint.child and joint.type != "gearbox":
                yield _link(joint.parent, scope, graph), _link(joint.child, scope, graph)


def _link(name: str, scope: str, graph: FrameGraph) -> str:
    """The link that an end of a joint is; of one in an include that was not read, what stands there."""
    if name == "world":
        return name
    try:
        return graph.body(scope + name)
    except FrameError:
        return scope + name


def _depth(parents: dict[str, str]) -> int:
    depths: dict[str, int] = {}
    for start in parents:
        path: list[str] = []
        link = start
        while link in parents and link not in depths:
            path.append(link)
            link = parents[link]
        for below in reversed(path):
            depths[below] = depths.get(parents[below], 0) + 1
    return max(depths.values(), default=0)
