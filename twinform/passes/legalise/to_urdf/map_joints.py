"""Joint types, limits and mimicry in terms of URDF."""

import math
from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate
from twinform.diagnostics.rules import to_sdf as shared_rules
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Axis, Joint, Limit, Mimic, Model, Node, Opaque
from twinform.passes.legalise.marks import mark_made
from twinform.passes.legalise.nodes import text_piece
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper
from twinform.schemas import format_value

AnyNode = TypeVar("AnyNode", bound=Node)

_WITHOUT_STRENGTH = ("effort", "velocity", "stiffness", "dissipation")
"""What goes from the limit of a continuous joint without strength: URDF would ask for the strength beside the rest."""
_TYPES = frozenset({"fixed", "revolute", "continuous", "prismatic", "floating", "planar"})
_DIALECT = frozenset({"ball", "spherical"})
"""What a dialect of URDF calls a joint that came from there; another ball joint is a chain by now."""
_UNBOUNDED = 1e16
"""What stands for infinity, as it does in SDF before 1.10: rad, m, N m, N, rad/s or m/s."""


class MapJoints(ToUrdfPass):
    """Say joints as URDF does.

    Changes: 1. a revolute joint without an end to its motion is continuous; 2. where URDF needs a number and the limit
    is infinite or not written, it is 1e16; 3. the `reference` of a mimic goes into its offset.
    Diagnostics: `joint-type-unsupported`; in the ledger `unbounded-limit` and `sdf-only`.
    """

    name: ClassVar[str] = "map-joints"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with joints of URDF."""
        return model.model_copy(update={"joints": tuple(_map(joint, keeper) for joint in model.joints)})


def _map(joint: Joint, keeper: Keeper) -> Joint:
    if joint.type in _DIALECT:
        return joint
    if joint.type not in _TYPES:
        message = f"joint {joint.name!r} is {joint.type}, a type that URDF does not have"
        where = joint.location.at("@type")
        keeper.notes.report(shared_rules.JOINT_TYPE_UNSUPPORTED, message, where, found=joint.type)
        return joint
    if joint.type == "continuous":
        message = f"joint {joint.name!r} is called continuous, which is revolute without limits in most of SDF"
        piece = Opaque(attribute=("type", "continuous"))
        joint = keeper.keep(joint, [piece], rules.SDF_ONLY, message, joint.location)
    if joint.axis is None or joint.type in {"fixed", "floating", "planar"}:
        return joint
    joint = _map_mimic(joint, joint.axis, keeper)
    axis = joint.axis or Axis()
    limit = axis.limit or Limit()
    if joint.type in {"revolute", "continuous"} and (joint.type == "continuous" or _is_endless(limit)):
        joint, limit = _continuous(joint.model_copy(update={"type": "continuous"}), limit, keeper)
    else:
        joint, limit = _bounded(joint, limit, keeper)
    made = None if limit == Limit() else limit
    return joint.model_copy(update={"axis": axis.model_copy(update={"limit": made})})


def _is_endless(limit: Limit) -> bool:
    return not _is_bound(limit.lower) and not _is_bound(limit.upper)


def _is_bound(value: float | None) -> bool:
    return value is not None and abs(value) < _UNBOUNDED  # which nan is not either


def _is_strength(value: float | None) -> bool:
    """Whether it limits effort or velocity: negative is infinite in SDF."""
    return value is not None and 0 <= value < math.inf


def _continuous(joint: Joint, limit: Limit, keeper: Keeper) -> tuple[Joint, Limit]:
    joint = _keep_written(joint, limit, ("lower", "upper"), keeper)
    limit = limit.model_copy(update={"lower": None, "upper": None})
    if _is_strength(limit.effort) or _is_strength(limit.velocity):
        return _fill(joint, limit, dict.fromkeys(("effort", "velocity"), _UNBOUNDED), keeper)
    joint = _keep_written(joint, limit, _WITHOUT_STRENGTH, keeper)
    return joint, limit.model_copy(update=dict.fromkeys(_WITHOUT_STRENGTH))


def _bounded(joint: Joint, limit: Limit, keeper: Keeper) -> tuple[Joint, Limit]:
    ends = {"lower": -_UNBOUNDED, "upper": _UNBOUNDED, "effort": _UNBOUNDED, "velocity": _UNBOUNDED}
    return _fill(joint, limit, ends, keeper)


def _fill(joint: Joint, limit: Limit, numbers: dict[str, float], keeper: Keeper) -> tuple[Joint, Limit]:
    """Put the numbers in where there is none that URDF can say, and keep what was written."""
    said = {"lower": _is_finite, "upper": _is_finite, "effort": _is_strength, "velocity": _is_strength}
    missing = {name: number for name, number in numbers.items() if not said[name](getattr(limit, name))}
    if not missing:
        return joint, limit
    joint = _keep_written(joint, limit, tuple(missing), keeper)
    joint = mark_made(joint, *(f"axis.limit.{name}" for name in missing if getattr(limit, name) is None))
    for name, number in missing.items():
        message = f"the {name} limit of {joint.type} joint {joint.name!r} is infinite; URDF gets {number:g}"
        keeper.notes.account(Fate.APPROXIMATED, rules.UNBOUNDED_LIMIT, message, joint.location, 0)
    return joint, limit.model_copy(update=missing)


def _is_finite(value: float | None) -> bool:
    return value is not None and math.isfinite(value)


def _keep_written(joint: Joint, limit: Limit, names: tuple[str, ...], keeper: Keeper) -> Joint:
    written = [(name, getattr(limit, name)) for name in names if getattr(limit, name) is not None]
    pieces = [text_piece(name, format_value(value), "axis/limit") for name, value in written]
    message = f"joint {joint.name!r} has {' and '.join(f'{name} {value:g}' for name, value in written)}"
    return keeper.keep(joint, pieces, rules.SDF_ONLY, message, limit.location)


def _map_mimic(joint: Joint, axis: Axis, keeper: Keeper) -> Joint:
    """A mimic of multiplier (leader - reference) + offset is multiplier leader + (offset - multiplier reference)."""
    mimic = axis.mimic
    if mimic is None or mimic.reference is None:
        return joint
    update: dict[str, object] = {"reference": None}
    written = [("reference", mimic.reference)]
    if mimic.reference:
        factor = 1.0 if mimic.multiplier is None else mimic.multiplier
        update["offset"] = (mimic.offset or 0.0) - factor * mimic.reference
        if mimic.offset is None:
            joint = mark_made(joint, "axis.mimic.offset")
        else:
            written.append(("offset", mimic.offset))
    pieces = [text_piece(name, format_value(value), "axis/mimic") for name, value in written]
    message = f"the reference of the mimic joint {joint.name!r} is part of its offset in URDF"
    made: Mimic = mimic.model_copy(update=update)
    joint = joint.model_copy(update={"axis": axis.model_copy(update={"mimic": made})})
    return keeper.keep(joint, pieces, rules.SDF_ONLY, message, mimic.location)
