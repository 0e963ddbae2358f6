"""Inertias that no body has, where those of links that are fixed to theirs make up for them.

libsdformat puts fixed links together when it reads URDF, and only then asks whether a body can have the inertia. In SDF
every link is asked. What a link has too little of is taken from another of the same body, so that the body as a whole
has the inertia that it had.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from twinform.ir import Format, Inertial, Link, Model
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.principal_moments import Symmetric
from twinform.ir.solids import combined, placed, turned
from twinform.ir.transform import Transform
from twinform.ir.verify.inertia import inertia_matrix, is_plain
from twinform.passes.inertia.physical_consistency import clearances, doubt, is_clearly_possible, nearest_possible
from twinform.passes.structure.bodies import body_of
from twinform.passes.structure.tagged_shapes import hosts_of

_MARGIN = 1e-6
"""The least second moment of mass along an axis, as a part of the trace: digits are cut off again."""
_ROUNDING = 1e-12
"""How much of the largest moment the digits of a file may lack."""


def shared_inertias(model: Model) -> dict[str, Symmetric]:
    """The elements of the inertias of a URDF that have to change in SDF, by link."""
    written = {link.name: link for link in model.links}
    needy = [link for link in model.links if is_refused(_matrix(link))]
    if not needy:
        return {}
    graph, hosts = FrameGraph(model), hosts_of(model)
    found: dict[str, Symmetric] = {}
    for host in dict.fromkeys(hosts[link.name] for link in needy):
        members = [written[name] for name, other in hosts.items() if other == host and name in written]
        try:
            found |= _of_body(members, host, graph)
        except FrameError:
            continue
    return found


def _matrix(link: Link) -> Symmetric | None:
    inertial = link.inertial
    if inertial is None or inertial.auto or inertial.inertia is None:
        return None
    return inertia_matrix(inertial.inertia, None)


def is_refused(matrix: Symmetric | None) -> bool:
    """Whether libsdformat refuses an inertia, or may."""
    if matrix is None or not any(matrix) or not all(map(math.isfinite, matrix)) or is_plain(matrix):
        return False
    return min(clearances(matrix)) < -max(_ROUNDING, doubt(matrix))


def _of_body(members: Sequence[Link], host: str, graph: FrameGraph) -> dict[str, Symmetric]:
    """What changes in the links of one body; nothing where the body is not possible as a whole, or cannot be shared."""
    matrices = {link.name: matrix for link in members if (matrix := _matrix(link))}
    if not all(math.isfinite(number) for matrix in matrices.values() for number in matrix):
        return {}
    whole = combined([placed(body_of(link, graph, Format.URDF), graph.pose(link.name, host)) for link in members])
    if not is_clearly_possible(whole.inertia):
        return {}
    places = {link.name: _inertial_in(link.inertial, link.name, host, graph) for link in members}
    found: dict[str, Symmetric] = {}
    for name in [name for name, matrix in matrices.items() if is_refused(matrix)]:
        made = nearest_possible(matrices[name], _MARGIN * abs(sum(matrices[name][:3])))
        change = _minus(made, matrices[name])
        giver = next(_givers(name, change, matrices, places), None)
        if giver is None:
            return {}
        found |= {name: made, giver[0]: giver[1]}
        matrices |= found
    return found


def _inertial_in(inertial: Inertial | None, link: str, host: str, graph: FrameGraph) -> Transform:
    return graph.pose(link, host).compose(graph.resolve(inertial and inertial.pose, link, link))


def _givers(
    name: str, change: Symmetric, matrices: Mapping[str, Symmetric], places: Mapping[str, Transform]
) -> Iterator[tuple[str, Symmetric]]:
    """Other links, those with the most first, and what they have left without the change; one that is possible."""
    for other in sorted(matrices, key=lambda each: -sum(matrices[each][:3])):
        if other != name and is_clearly_possible(matrices[other]):
            left = _minus(matrices[other], turned(change, places[other].inverse().compose(places[name])))
            if is_clearly_possible(left):
                yield other, left


def _minus(one: Symmetric, other: Symmetric) -> Symmetric:
    xx, yy, zz, xy, xz, yz = (a - b for a, b in zip(one, other, strict=True))
    return xx, yy, zz, xy, xz, yz
