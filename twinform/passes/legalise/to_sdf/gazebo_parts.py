"""Links and joints that stand as SDF in a `<gazebo>` element, with the defaults of SDF where URDF has others."""

from twinform.ir import Axis, Format, Joint, Link
from twinform.ir.defaults import INERTIAL, direction, with_range

_HAS_AXIS = frozenset({"revolute", "continuous", "prismatic", "screw"})


def with_mass(link: Link) -> Link:
    """A link that says nothing about its mass has 1 kg in SDF; in URDF it has none."""
    return link if link.inertial is not None else link.model_copy(update={"inertial": INERTIAL})


def with_axis(joint: Joint) -> Joint:
    """An axis that is not written is z in SDF and x in URDF; a limit that is not written is none at all, or zero."""
    if joint.type not in _HAS_AXIS:
        return joint
    axis = joint.axis or Axis()
    update = {"xyz": direction(axis, Format.SDF), "limit": axis.limit and with_range(axis.limit, Format.SDF)}
    return joint.model_copy(update={"axis": axis.model_copy(update=update)})
