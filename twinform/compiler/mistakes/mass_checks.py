"""Which masses and inertias are worth a look: a quick question of each link, before the exact one of `unit_check`."""

import math
from collections.abc import Container

from twinform.compiler.mistakes.mesh_files import MeshFiles
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Document, Inertial, Link, Mesh, Vector3, Visual
from twinform.ir.bounds import bounds
from twinform.passes.shared.moving_bodies import movable_models

# Each leaves more room than `unit_check` does: whatever that reports passes this.
_HEAVY = 50000.0
"""A mass in the boxes around shapes, kg/m^3."""
_LARGE = 300.0
_SMALL = 1e-3
_FELT = 0.03
"""A sum of moments, kg m^2, below which no inertia is too large: nobody feels it, and it keeps a simulation stable."""
_OFF = 0.5
"""How far a center of mass may be away from the link, m."""


def report_masses(document: Document, files: MeshFiles, odd: Container[int], sink: DiagnosticSink) -> None:
    """Report masses and inertias that the shapes of their links are far from, but for links with `odd` shapes."""
    for model in movable_models(document):
        for link in model.links:
            inertial = link.inertial
            if inertial and not inertial.auto and id(link) not in odd and _is_suspect(link, inertial, files):
                # few robots have such a link, and the exact check has many modules
                from twinform.compiler.mistakes.unit_check import report_mass  # noqa: PLC0415 - see above

                report_mass(link, inertial, (model, document.format), files, sink)


def _is_suspect(link: Link, inertial: Inertial, files: MeshFiles) -> bool:
    """Tell cheaply whether a mass or inertia may be far from what the shapes of a link suggest."""
    holders = (*link.collisions, *link.visuals)
    mass, inertia = inertial.mass, inertial.inertia
    if not holders or not mass or mass < 0 or inertia is None:
        return False
    sizes = [_size(each, files) for each in holders]
    known = [each for each in sizes if each is not None]
    if len(known) < len(sizes):
        return False
    trace = sum(abs(each or 0.0) for each in (inertia.ixx, inertia.iyy, inertia.izz))
    thin, wide = min(map(min, known)), sum(map(max, known)) + sum(map(_offset, holders))
    volume = min(math.prod(each) for each in known)
    return (
        trace > max(_LARGE * mass * thin * thin / 4, _FELT)
        or 0 < trace < _SMALL * mass * wide * wide
        or mass > _HEAVY * volume
        or _offset(inertial) > _OFF
    )


def _size(holder: Visual | Collision, files: MeshFiles) -> Vector3 | None:
    shape = holder.geometry.shape if holder.geometry else None
    if not isinstance(shape, Mesh):
        box = bounds(shape)
        return box.size if box else None
    box = files.box(shape.uri or "")
    if box is None:
        return None
    x, y, z = (abs(length * factor) for length, factor in zip(box.size, shape.scale or (1.0, 1.0, 1.0), strict=True))
    return x, y, z


def _offset(placed: Visual | Collision | Inertial) -> float:
    """How far a part is away from its link; 0 where its pose names another frame."""
    return math.hypot(*placed.pose.xyz) if placed.pose and placed.pose.xyz else 0.0
