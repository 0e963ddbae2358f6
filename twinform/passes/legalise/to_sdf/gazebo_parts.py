"""Links and joints that stand as SDF in a `<gazebo>` element, with the defaults of SDF where URDF has others."""

import math
from typing import Any

from twinform.ir import Axis, Inertia, Inertial, Joint, Limit, Link

_Z = (0.0, 0.0, 1.0)
_DEFAULT = Inertial(mass=1.0, inertia=Inertia(ixx=1.0, ixy=0.0, ixz=0.0, iyy=1.0, iyz=0.0, izz=1.0))
_HAS_AXIS = frozenset({"revolute", "continuous", "prismatic", "screw"})


def with_mass(link: Link) -> Link:
    """A link that says nothing about its mass has 1 kg in SDF; in URDF it has none."""
    return link if link.inertial is not None else link.model_copy(update={"inertial": _DEFAULT})


def with_axis(joint: Joint) -> Joint:
    """An axis that is not written is z in SDF and x in URDF; a limit that is not written is none at all, or zero."""
    if joint.type not in _HAS_AXIS:
        return joint
    axis = joint.axis or Axis()
    update: dict[str, Any] = {} if axis.xyz is not None else {"xyz": _Z}
    if axis.limit is not None:
        update["limit"] = _unlimited(axis.limit)
    return joint.model_copy(update={"axis": axis.model_copy(update=update)})


def _unlimited(limit: Limit) -> Limit:
    lower = -math.inf if limit.lower is None else limit.lower
    upper = math.inf if limit.upper is None else limit.upper
    return limit.model_copy(update={"lower": lower, "upper": upper})
