"""Converting joint types, limits and mimics to URDF."""

import math
from collections.abc import Mapping
from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, rules
from twinform.ir import Axis, Joint, Limit, Mimic, Model, Node
from twinform.ir.defaults import UNLIMITED, multiplier
from twinform.passes.carriers.annotations import CONTINUOUS, MIMIC, find_annotation
from twinform.passes.legalise.drake_joints import DRAKE, DRAKE_TYPES
from twinform.passes.legalise.to_urdf.remainder import urdf_row
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.legalise.urdf_pieces import BALLS
from twinform.passes.shared.nodes import text_piece
from twinform.request_options import UrdfVersion
from twinform.schemas import format_value

AnyNode = TypeVar("AnyNode", bound=Node)

_WITHOUT_STRENGTH = ("effort", "velocity", "stiffness", "dissipation")
"""The limits that a continuous joint without strength loses: beside them URDF would require the strength."""
_LIMITS = ("lower", "upper", "effort", "velocity")
_TYPES = frozenset({"fixed", "revolute", "continuous", "prismatic", "floating", "planar"})
_FORCES = ("effort", "velocity")


class MapJoints(ToUrdfPass):
    """Say joints as URDF does.

    Changes: 1. a revolute joint without an end to its motion is continuous; 2. where URDF needs a number and the limit
    is infinite or not written, it is 1e16; URDF 1.2 needs neither effort nor velocity; 3. the `reference` of a mimic
    goes into its offset.
    Diagnostics: `joint-type-unsupported`; in the ledger `unbounded-limit` and `sdf-only`.
    """

    name: ClassVar[str] = "map-joints"
    urdf_version: UrdfVersion = "1.0"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with joints of URDF."""
        # URDF 1.0 and 1.1 ask for finite numbers where SDF has infinity.
        strength = UNLIMITED if urdf_row(self.urdf_version, "joint", "limit", "@effort").required else None
        return model.copy(joints=tuple(_map_joint(joint, strength, keeper) for joint in model.joints))


def _map_joint(joint: Joint, strength: float | None, keeper: UrdfKeeper) -> Joint:
    """The joint in URDF; `strength` is written for an unlimited effort or velocity, unless it is None."""
    if joint.type in BALLS or (
        joint.type in DRAKE_TYPES and find_annotation(joint, DRAKE)
    ):  # it came from a dialect of URDF; another one is a chain by now
        return joint
    if joint.type not in _TYPES:
        message = f"joint {joint.name!r} is {joint.type}, a type that URDF does not have"
        where = joint.location.at("@type")
        keeper.sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, where, found=joint.type)
        return joint
    if joint.type == "continuous":
        message = f"joint {joint.name!r} is continuous, which most SDF files write as revolute without limits"
        keeper.account(rules.SDF_ONLY, message, joint.location, 1)
        joint = keeper.annotate(joint, CONTINUOUS)
    if joint.axis is None or joint.type in {"fixed", "floating", "planar"}:
        return joint
    joint = _map_mimic(joint, joint.axis, keeper)
    axis = joint.axis or Axis.unchecked()
    limit = axis.limit or Limit.unchecked()
    # URDF asks for limits in a revolute joint, so a joint of a URDF without any can only have been
    # continuous, and nothing needs to be annotated.
    endless = limit.lower is None and limit.upper is None if keeper.back else _is_endless(limit)
    if joint.type == "continuous" or (joint.type == "revolute" and endless):
        joint, limit = _map_continuous(joint.copy(type="continuous"), limit, strength, keeper)
    else:
        limit = _fill_limit(
            joint, limit, {"lower": -UNLIMITED, "upper": UNLIMITED, **dict.fromkeys(_FORCES, strength)}, keeper
        )
    made = None if limit == Limit.unchecked() else limit
    return joint.copy(axis=axis.copy(limit=made))


def _is_endless(limit: Limit) -> bool:
    return not _is_bound(limit.lower) and not _is_bound(limit.upper)


def _is_bound(value: float | None) -> bool:
    return value is not None and abs(value) < UNLIMITED  # which nan is not either


def _is_strength(value: float | None) -> bool:
    """Whether a value limits effort or velocity; negative values are infinite in SDF."""
    return value is not None and 0 <= value < math.inf


def _map_continuous(joint: Joint, limit: Limit, strength: float | None, keeper: UrdfKeeper) -> tuple[Joint, Limit]:
    ends = tuple(name for name in ("lower", "upper") if _is_bound(getattr(limit, name)))
    joint = _keep_written(joint, limit, ends, keeper)
    endless = [name for name in _LIMITS if name not in ends and not _limits(limit, name)]
    if endless:
        message = f"infinite limits of joint {joint.name!r} are not written in URDF: {', '.join(endless)}"
        keeper.account(rules.UNBOUNDED_LIMIT, message, limit.location, len(endless))
    limit = limit.copy(lower=None, upper=None)
    if _is_strength(limit.effort) or _is_strength(limit.velocity):
        return joint, _fill_limit(joint, limit, dict.fromkeys(_FORCES, strength), keeper)
    joint = _keep_written(joint, limit, ("stiffness", "dissipation"), keeper)
    return joint, limit.copy(**dict.fromkeys(_WITHOUT_STRENGTH))


def _fill_limit(joint: Joint, limit: Limit, numbers: Mapping[str, float | None], keeper: UrdfKeeper) -> Limit:
    """The limit with numbers where URDF requires finite ones; None stands for one that is not required."""
    strength = _is_finite if keeper.back else _is_strength
    valid = {"lower": _is_finite, "upper": _is_finite, "effort": strength, "velocity": strength}
    missing = {name: number for name, number in numbers.items() if not valid[name](getattr(limit, name))}
    for name, number in missing.items():
        if number is None:
            continue
        message = f"the {name} limit of {joint.type} joint {joint.name!r} is infinite; URDF needs a number: {number:g}"
        keeper.sink.account(Fate.APPROXIMATED, rules.UNBOUNDED_LIMIT, message, joint.location, 0)
    return limit.copy(**missing) if missing else limit


def _is_finite(value: float | None) -> bool:
    return value is not None and math.isfinite(value)


def _keep_written(joint: Joint, limit: Limit, names: tuple[str, ...], keeper: UrdfKeeper) -> Joint:
    written = [(name, getattr(limit, name)) for name in names if getattr(limit, name) is not None]
    pieces = [text_piece(name, format_value(value), "axis/limit") for name, value in written]
    message = f"joint {joint.name!r} has {' and '.join(f'{name} {value:g}' for name, value in written)}"
    return keeper.keep(joint, pieces, rules.SDF_ONLY, message, limit.location)


def _map_mimic(joint: Joint, axis: Axis, keeper: UrdfKeeper) -> Joint:
    """The joint with the reference of its mimic in the offset.

    multiplier (leader - reference) + offset = multiplier leader + (offset - multiplier reference).
    """
    mimic = axis.mimic
    if mimic is None or mimic.reference is None:
        return joint
    factor = multiplier(mimic)
    offset = (mimic.offset or 0.0) - factor * mimic.reference if mimic.reference else mimic.offset
    made: Mimic = mimic.copy(reference=None, offset=offset)
    joint = joint.copy(axis=axis.copy(mimic=made))
    message = f"the reference of the mimic joint {joint.name!r} is part of its offset in URDF"
    keeper.account(rules.SDF_ONLY, message, mimic.location, 1)
    return keeper.annotate(joint, MIMIC, attributes={"reference": format_value(mimic.reference)})


def _limits(limit: Limit, name: str) -> bool:
    """Whether a limit is absent or really limits something."""
    value = getattr(limit, name)
    return value is None or (name in {"effort", "velocity"} and _is_strength(value))
