"""Inertias that no body has, where those of links that are fixed to theirs make up for them.

libsdformat puts fixed links together when it reads URDF, and only then asks whether a body can have the inertia. In SDF
every link is asked. So such a link and others of its body have in SDF what they are together, by their masses: each has
its own mass, at the center of them all, and as much of their inertia as it has of their mass.
"""

import math
from collections import defaultdict
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from contextlib import suppress

from twinform.ir import Format, Link, Model
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.principal_moments import Symmetric
from twinform.ir.solids import Solid, combined, placed, with_mass
from twinform.ir.verify.inertia import inertia_matrix, is_plain
from twinform.passes.inertia.physical_consistency import clearances, doubt, has_mass, is_clearly_possible
from twinform.passes.structure.bodies import body_of
from twinform.passes.structure.tagged_shapes import hosts_of

_ROUNDING = 1e-12
"""How much of the largest moment the digits of a file may lack."""


def shared_inertias(model: Model) -> dict[str, Solid]:
    """What links of a URDF have to be in SDF, in their own frames: those that have to change."""
    needy = {link.name for link in model.links if is_refused(_matrix(link))}
    if not needy:
        return {}
    graph, hosts = FrameGraph(model), hosts_of(model)
    bodies = defaultdict[str, list[Link]](list)
    for link in model.links:
        if _matrix(link) and (has_mass(link.inertial) or hosts[link.name] == link.name):
            bodies[hosts[link.name]].append(link)
    found: dict[str, Solid] = {}
    for members in bodies.values():
        if any(link.name in needy for link in members):
            with suppress(FrameError):
                found |= _of_body(members, needy, graph)
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


def _of_body(members: Sequence[Link], needy: AbstractSet[str], graph: FrameGraph) -> dict[str, Solid]:
    """What changes in the links of one body: impossible ones, and as many others, heavy ones first, as it takes.

    Nothing where the body is not possible as a whole.
    """
    places = {link.name: graph.pose(link.name, members[0].name) for link in members}
    solids = {link.name: placed(body_of(link, graph, Format.URDF), places[link.name]) for link in members}
    group = {name: one for name, one in solids.items() if name in needy}
    whole = combined([*group.values()])
    for name in sorted(solids.keys() - needy, key=lambda each: (-solids[each].mass, each)):
        if whole.mass and is_clearly_possible(whole.inertia):
            break
        group[name] = solids[name]
        whole = combined([whole, solids[name]] if whole.mass else [*group.values()])
    if not whole.mass or not all(map(math.isfinite, whole.inertia)) or is_refused(whole.inertia):
        return {}
    return {name: placed(with_mass(whole, one.mass), places[name].inverse()) for name, one in group.items()}
