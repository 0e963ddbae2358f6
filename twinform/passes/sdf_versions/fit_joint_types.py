"""Joint types that SDF 1.5 and 1.6 introduced, and one that was removed."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Axis, Document, Format, Joint, Limit, Opaque, rewrite
from twinform.ir.defaults import AXIS
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.nodes import text_piece
from twinform.schemas import Version, format_value, print_version

_NEWER: dict[str, Version] = {"gearbox": (1, 4), "fixed": (1, 5), "screw": (1, 5), "continuous": (1, 6)}
_OLDER: dict[str, Version] = {"piston": (1, 4)}
_STILL = Axis.unchecked(xyz=AXIS[Format.SDF], limit=Limit.unchecked(lower=0.0, upper=0.0))


class FitJointTypes(VersionPass):
    """Write the types of joints as an older version does.

    Changes: 1. `continuous` before 1.6 is `revolute`, without an end to its motion; 2. `fixed` before 1.5 is `revolute`
    between zero and zero.
    Diagnostics: `joint-type-unsupported` for `gearbox` before 1.4, `screw` before 1.5 and `piston` after 1.4.
    """

    name: ClassVar[str] = "fit-joint-types"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with joints of the version."""
        return rewrite(document, Joint, partial(_fit_joint, keeper, self.number))


def _fit_joint(keeper: VersionKeeper, version: Version, joint: Joint) -> Joint:
    since, until = _NEWER.get(joint.type, (0, 0)), _OLDER.get(joint.type, (99, 99))
    if since <= version <= until:
        return joint
    if joint.type == "continuous":
        return _fit_continuous(keeper, joint)
    if joint.type == "fixed":
        return _fit_fixed(keeper, joint)
    message = f"joint {joint.name!r} is {joint.type}, a type that SDF {print_version(version)} does not have"
    keeper.sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, joint.location.at("@type"), found=joint.type)
    return joint


def _fit_continuous(keeper: VersionKeeper, joint: Joint) -> Joint:
    pieces = [_type_piece(joint)]
    changed = joint.copy(type="revolute")
    # A range counts in a revolute joint and not in a continuous one, so it has to go before the
    # type changes.
    limit = joint.axis.limit if joint.axis else None
    if joint.axis and limit:
        ends = {name: getattr(limit, name) for name in ("lower", "upper") if getattr(limit, name) is not None}
        pieces += [text_piece(name, format_value(value), "axis/limit") for name, value in ends.items()]
        endless = limit.copy(**dict.fromkeys(ends))
        changed = changed.copy(axis=joint.axis.copy(limit=endless))
    return _keep_joint(keeper, changed, joint, pieces, VersionCondition(since=_NEWER["continuous"]))


def _fit_fixed(keeper: VersionKeeper, joint: Joint) -> Joint:
    pieces = [_type_piece(joint)]
    if joint.axis is not None:
        written = to_element(Joint.unchecked(name="", type="fixed", axis=joint.axis), "joint", "sdf").find("axis")
        pieces += [Opaque.unchecked(element=written)] if written else []
    # What older versions of libsdformat made of a fixed joint of URDF themselves.
    changed = joint.copy(type="revolute", axis=_STILL)
    return _keep_joint(keeper, changed, joint, pieces, VersionCondition(since=_NEWER["fixed"], without=("axis",)))


def _type_piece(joint: Joint) -> Opaque:
    return Opaque.unchecked(attribute=("type", joint.type))


def _keep_joint(
    keeper: VersionKeeper, changed: Joint, joint: Joint, pieces: list[Opaque], condition: VersionCondition
) -> Joint:
    message = f"joint {joint.name!r} is {joint.type}, which the version calls {changed.type}"
    return keeper.keep(changed, pieces, condition, rules.OTHER_WORDS, message, joint.location, len(pieces))
