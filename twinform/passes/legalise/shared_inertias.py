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
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Format, Inertia, Inertial, Link, Model, Pose
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.node import Vector3
from twinform.ir.solids import ELEMENTS, ORIGIN, Solid, Symmetric, combined, placed, tensor, turned, with_mass
from twinform.ir.verify.verify_bodies import inertia_matrix, is_plain
from twinform.passes.carriers.annotations import came_from, find_annotation, with_annotation, without_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.inertia.physical_consistency import (
    clearances,
    has_mass,
    is_clearly_possible,
    nearest_possible,
    rounding_loss,
)
from twinform.passes.shared.gazebo_tags import lumped_links
from twinform.passes.shared.link_shapes import body_of, write_solid
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


class ShareInertias(ModelPass):
    """Make inertias possible that no body has, with what links have that are fixed to theirs.

    Changes: 1. the inertia of a link that libsdformat would refuse in SDF, and takes in URDF, where fixed links are one
    body, becomes the nearest that a body can have; another link of that body has as much less. 2. Where no other has
    enough, the link and as many others as it takes keep their masses, at the center of them all, and each has as much
    of the inertia that they have together as it has of their mass. The body is what it was.
    Never touches: a body that is impossible as a whole.
    Diagnostics: `shared-inertia`; the ledger has each link. The old center and inertia are carried.
    """

    name: ClassVar[str] = "share-inertias"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with inertias that libsdformat takes."""
        # Such a URDF was never refused as SDF, and an edit that made an inertia impossible stands
        # as it is written.
        if came_from(model, Format.SDF):
            return model
        found = shared_inertias(model)
        if not found:
            return model
        return model.copy(links=tuple(self._share(link, found, sink) for link in model.links))

    def _share(self, link: Link, found: dict[str, Solid], sink: DiagnosticSink) -> Link:
        written = link.inertial
        if written is None or link.name not in found:
            return link
        made, old = write_solid(written, found[link.name]), written.pose or Pose.unchecked()
        moved = found[link.name].center != (old.xyz or ORIGIN)
        made = made if moved else made.copy(pose=written.pose)
        what = "center of mass and inertia" if moved else "inertia"
        message = f"link {link.name!r} has another {what} in SDF, and with the links that are fixed to it the same"
        sink.report(rules.SHARED_INERTIA, message, written.location, found=link.name)
        where = written.location
        sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("inertia"), len(ELEMENTS))
        if moved and old.xyz:
            sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("origin/@xyz"))
        return link.copy(inertial=with_share(made, written) if self.carriers else made)


_CLOSE = 1e-9
"""How far numbers may be apart that were computed from the same ones: in m, and relative to the largest."""


class RestoreInertias(ModelPass):
    """Give links the inertias that they had before they were shared with links that are fixed to them.

    Changes: all annotated inertias, if the old ones would be shared again just so.
    Never touches: any of them once masses, places or joints were edited so that another share would come out.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-inertias"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with its old inertias."""
        old = {
            link.name: inertial
            for link in model.links
            if link.inertial is not None and (inertial := without_share(link.inertial)) is not None
        }
        if not old:
            return model
        restored = _with_inertials(model, old)
        shared, graph = shared_inertias(restored), FrameGraph(model)
        now = {link.name: body_of(link, graph, Format.URDF) for link in model.links if link.name in old}
        # Proved by repetition: the old inertias come back if sharing them would give the numbers of
        # the file again.
        if shared.keys() == old.keys() and all(_are_close(shared[name], now[name]) for name in old):
            return restored
        for link in model.links:
            if link.name in old and link.inertial:
                message = f"the inertia of link {link.name!r} stays: the body that it is a part of was edited"
                sink.report(STALE_CARRIER, message, link.inertial.location, found=link.name)
        bare = {
            link.name: without_annotation(link.inertial, SHARED)
            for link in model.links
            if link.inertial and link.name in old
        }
        return _with_inertials(model, bare)


def _with_inertials(model: Model, inertials: dict[str, Inertial]) -> Model:
    links = (link.copy(inertial=inertials[link.name]) if link.name in inertials else link for link in model.links)
    return model.copy(links=tuple(links))


def _are_close(one: Solid, other: Solid) -> bool:
    return all(
        math.isclose(a, b, rel_tol=0, abs_tol=_CLOSE * size)
        for there, here, size in (
            (one.center, other.center, max(1.0, *map(abs, one.center))),
            (one.inertia, other.inertia, max(map(abs, one.inertia))),
        )
        for a, b in zip(there, here, strict=True)
    )
