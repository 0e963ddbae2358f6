"""What SDF assumes about mass, URDF has to be told."""

from typing import ClassVar

from twinform.ir import Inertia, Inertial, Link, Model, replace_fields
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper

_UNIT = {"ixx": 1.0, "ixy": 0.0, "ixz": 0.0, "iyy": 1.0, "iyz": 0.0, "izz": 1.0}
"""SDF's defaults, kg m^2."""
_MASS = 1.0
"""SDF's default, kg."""


class FillInertials(ToUrdfPass):
    """Write the mass and inertia that SDF gives to every link that says nothing about them.

    Changes: a missing mass is 1 kg, a missing `ixx`, `iyy`, `izz` 1 kg m^2 and a missing product of inertia 0. These
    are the values that every reader of SDF takes; a reader of URDF would take none.
    Diagnostics: none.
    """

    name: ClassVar[str] = "fill-inertials"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with an inertial in every link."""
        return model.model_copy(update={"links": tuple(map(_fill_link, model.links))})


def _fill_link(link: Link) -> Link:
    if link.inertial is None:
        made = Inertial(mass=_MASS, inertia=Inertia().model_copy(update=_UNIT))
        return link.model_copy(update={"inertial": made})
    inertial = _fill(link.inertial)
    return replace_fields(link, inertial=inertial)


def _fill(inertial: Inertial) -> Inertial:
    inertia = inertial.inertia or Inertia()
    missing = {name: value for name, value in _UNIT.items() if getattr(inertia, name) is None}
    if not missing and inertial.mass is not None:
        return inertial
    update: dict[str, object] = {"inertia": inertia.model_copy(update=missing)}
    if inertial.mass is None:
        update["mass"] = _MASS
    return inertial.model_copy(update=update)
