"""The annotation on an inertial of SDF with the inertia that URDF has, of which others of the body have a part in SDF.

<tf:shared ixx="1e-06" ixy="1e-06" ixz="1e-06" iyy="1e-06" iyz="1e-06" izz="1e-06"/>
"""

from twinform.ir import Inertia, Inertial
from twinform.ir.principal_moments import Symmetric
from twinform.ir.solids import ELEMENTS, tensor, with_tensor
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.schemas import format_value, parse_value

SHARED = "shared"


def with_share(inertial: Inertial, elements: Symmetric, *, annotated: bool) -> Inertial:
    """The inertial with other elements, and the old ones in an annotation."""
    written = dict(zip(ELEMENTS, tensor(inertial.inertia), strict=True))
    made = inertial.model_copy(update={"inertia": with_tensor(inertial.inertia, elements)})
    if not annotated:
        return made
    return with_annotation(made, SHARED, attributes={name: format_value(value) for name, value in written.items()})


def without_share(inertial: Inertial) -> Inertial | None:
    """The inertial as URDF had it; None where it has no annotation, or one that is no inertia."""
    found = find_annotation(inertial, SHARED)
    if found is None:
        return None
    try:
        old = {name: parse_value("double", found.get(name) or "") for name in ELEMENTS}
    except ValueError:
        return None
    inertia = (inertial.inertia or Inertia()).model_copy(update=old)
    return without_annotation(inertial, SHARED).model_copy(update={"inertia": inertia})
