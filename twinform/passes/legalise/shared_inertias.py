"""Inertias that no body has, where those of links that are fixed to theirs make up for them.

libsdformat puts fixed links together when it reads URDF, and only then asks whether a body can have the inertia. In SDF
every link is asked. What a link has too little of is taken from another of the same body, so that the body as a whole
has the inertia that it had. Where no other has enough, such links and others are in SDF what they are together: each
has its own mass, at the center of them all, and as much of their inertia as it has of their mass.
"""

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from contextlib import suppress
from dataclasses import replace

from twinform.ir import Format, Inertia, Inertial, Link, Model, Pose
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.node import Vector3
from twinform.ir.solids import ELEMENTS, ORIGIN, Solid, Symmetric, combined, placed, tensor, turned, with_mass
from twinform.ir.verify.verify_bodies import inertia_matrix, is_plain
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.passes.inertia.physical_consistency import (
    clearances,
    has_mass,
    is_clearly_possible,
    nearest_possible,
    rounding_loss,
)
from twinform.passes.shared.gazebo_tags import lumped_links
from twinform.passes.shared.link_shapes import body_of
from twinform.schemas import format_value, parse_value

_MARGIN = 1e-6
"""The least second moment of mass along an axis, as a part of the trace: digits are cut off again."""
_ROUNDING = 1e-12
"""How much of the largest moment the digits of a file may lack."""


def shared_inertias(model: Model) -> dict[str, Solid]:
    """What links of a URDF have to be in SDF, in their own frames: those that have to change."""
    needy = {link.name for link in model.links if is_refused(_matrix(link))}
    if not needy:
        return {}
    graph, hosts = FrameGraph(model), lumped_links(model)
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
    # Within the rounding of the file's own digits, an inertia on the boundary (a thin rod, a flat
    # plate) is possible.
    return min(clearances(matrix)) < -max(_ROUNDING, rounding_loss(matrix))


def _of_body(members: Sequence[Link], needy: AbstractSet[str], graph: FrameGraph) -> dict[str, Solid]:
    """What changes in the links of one body; nothing where the body is no possible one, or not finite."""
    own = {link.name: body_of(link, graph, Format.URDF) for link in members}
    if not _are_finite(own):
        return {}
    places = {name: graph.pose(name, members[0].name) for name in own}
    solids = {name: placed(one, places[name]) for name, one in own.items()}
    # The way that keeps all centers of mass comes first. hyq's root of 1e-6 kg has 1e-6 in all nine
    # elements, which Gazebo takes in URDF, where it lumps the body, and refuses in SDF. The nearest
    # possible inertia alone would make another robot, by some digits; lumping the links, another
    # tree.
    found = _with_givers(solids, needy)
    if found:
        return {name: replace(own[name], inertia=turned(each, places[name].inverse())) for name, each in found.items()}
    made = {name: placed(one, places[name].inverse()) for name, one in _together(solids, needy).items()}
    return made if _are_finite(made) else {}


def _are_finite(solids: Mapping[str, Solid]) -> bool:
    return all(math.isfinite(number) for one in solids.values() for number in (*one.center, *one.inertia))


def _with_givers(solids: Mapping[str, Solid], needy: AbstractSet[str]) -> dict[str, Symmetric]:
    """Possible inertias, of which others have as much less as they have more; nothing where none has enough."""
    inertias: dict[str, Symmetric] = {name: one.inertia for name, one in solids.items()}
    found: dict[str, Symmetric] = {}
    for name in [name for name in inertias if name in needy]:
        made = nearest_possible(inertias[name], _MARGIN * abs(sum(inertias[name][:3])))
        change = _minus(made, inertias[name])
        # The largest giver, for which the change is the smallest part; by name between equals, so
        # that results do not depend on hashing.
        others = sorted(inertias.keys() - {name}, key=lambda each: (-sum(inertias[each][:3]), each))
        rest = ((other, _minus(inertias[other], change)) for other in others if is_clearly_possible(inertias[other]))
        giver = next(((other, left) for other, left in rest if is_clearly_possible(left)), None)
        if giver is None:
            return {}
        found |= {name: made, giver[0]: giver[1]}
        inertias |= found
    return found


def _minus(one: Symmetric, other: Symmetric) -> Symmetric:
    xx, yy, zz, xy, xz, yz = (a - b for a, b in zip(one, other, strict=True))
    return xx, yy, zz, xy, xz, yz


def _together(solids: Mapping[str, Solid], needy: AbstractSet[str]) -> dict[str, Solid]:
    """Impossible links, and as many others, heavy ones first, as it takes: each is its part of what they all are."""
    group = {name: one for name, one in solids.items() if name in needy}
    # Possible wherever the body is, since each is a scaled copy of the whole; but it moves centers
    # of mass. Needed for two hands of a robot whose moments all lie apart.
    whole = combined([*group.values()])
    for name in sorted(solids.keys() - needy, key=lambda each: (-solids[each].mass, each)):
        if whole.mass and is_clearly_possible(whole.inertia):
            break
        group[name] = solids[name]
        whole = combined([whole, solids[name]] if whole.mass else [*group.values()])
    if not whole.mass or is_refused(whole.inertia):
        return {}
    return {name: with_mass(whole, one.mass) for name, one in group.items()}


SHARED = "shared"


def with_share(made: Inertial, written: Inertial) -> Inertial:
    """The inertial of SDF with the inertia of URDF, and its center of mass if it has moved, in an annotation."""
    numbers: dict[str, float | Vector3] = dict(zip(ELEMENTS, tensor(written.inertia), strict=True))
    if made.pose != written.pose:
        numbers = {"xyz": (written.pose and written.pose.xyz) or ORIGIN, **numbers}
    return with_annotation(made, SHARED, attributes={name: format_value(value) for name, value in numbers.items()})


def without_share(inertial: Inertial) -> Inertial | None:
    """The inertial as URDF had it; None where it has no annotation, or one that is no inertia."""
    found = find_annotation(inertial, SHARED)
    if found is None:
        return None
    try:
        old = {name: parse_value("double", found.get(name) or "") for name in ELEMENTS}
        place = parse_value("vector3", found.get("xyz") or "0 0 0")
    except ValueError:
        return None
    moved = (inertial.pose or Pose.unchecked()).copy(xyz=place)
    pose = moved if found.get("xyz") else inertial.pose
    inertia = (inertial.inertia or Inertia.unchecked()).copy(**old)
    return without_annotation(inertial, SHARED).copy(inertia=inertia, pose=pose)
