"""Writing the default mass and inertia of SDF, which URDF does not assume."""

from typing import ClassVar

from twinform.ir import Link, Model, replace_fields
from twinform.ir.solids import with_written_defaults
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper


class FillInertials(ToUrdfPass):
    """Write the mass and inertia that SDF gives to every link without them.

    Changes: a missing mass is 1 kg, a missing `ixx`, `iyy`, `izz` 1 kg m^2 and a missing product of inertia 0. These
    are the values that every reader of SDF takes; a reader of URDF would take none.
    Diagnostics: none.
    """

    name: ClassVar[str] = "fill-inertials"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with an inertial in every link."""
        return model.copy(links=tuple(map(_fill_link, model.links)))


def _fill_link(link: Link) -> Link:
    # A link without <inertial> weighs 1 kg in SDF (the specification, and every reader) and nothing
    # in URDF.
    return replace_fields(link, inertial=with_written_defaults(link.inertial))
