"""The annotation on an inertial of SDF with what URDF has, of which others of the body have a part in SDF.

<tf:shared xyz="0 0 0.1" ixx="1e-06" ixy="1e-06" ixz="1e-06" iyy="1e-06" iyz="1e-06" izz="1e-06"/>
"""

from twinform.ir import Inertia, Inertial, Pose
from twinform.ir.node import Vector3
from twinform.ir.solids import ELEMENTS, ORIGIN, tensor
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.schemas import format_value, parse_value

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
    moved = (inertial.pose or Pose()).copy(xyz=place)
    pose = moved if found.get("xyz") else inertial.pose
    inertia = (inertial.inertia or Inertia()).copy(**old)
    return without_annotation(inertial, SHARED).copy(inertia=inertia, pose=pose)
