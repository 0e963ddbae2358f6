"""Make one body of links that fixed joints hold together."""

from typing import ClassVar, Literal

from pydantic import Field

from twinform.diagnostics import rules
from twinform.ir import Format, Model
from twinform.passes.framework.pass_base import AssetPass, with_such_a_name
from twinform.passes.shared.mesh_solids import Meshes
from twinform.passes.structure.model_edit import EditContext, ModelEdit


class LumpFixedJoints(ModelEdit, AssetPass):
    """Put the mass and the shapes of a link on a fixed joint into the link that it is fixed to.

    Changes: 1. mass, center of mass and inertia of the link above; the axes that its inertia is written in stay, and an
    inertia that SDF leaves to be computed is computed, also from meshes; 2. in SDF the link and its joint become frames
    of their names, and visuals, collisions, sensors and lights move to the link above, posed in the old link's frame,
    each with its own surface; 3. in URDF, which has no frames, the link and its joint stay, without mass; its shapes
    move as well, unless `<gazebo>` sets other things for the two links' shapes; 4. with `compat=libsdformat` URDF
    becomes what libsdformat 12 makes of it: the link and the joint go, shapes are called
    `HOST_fixed_joint_lump__NAME`, joints and `<gazebo>` elements of the link go to the link above, and a fixed joint
    with `disableFixedJointLumping` turns by nothing.
    Never touches: joints to `world`; links and joints that `keep` names; joints with `preserveFixedJoint`, or, without
    `compat`, `disableFixedJointLumping`. Without `compat` also: a joint with a sensor, links and joints that a plugin,
    a transmission or another tool names, links with other gravity, wind, damping or self collision than their parent,
    loops of fixed joints.
    Diagnostics: `link-not-lumped`, `shapes-not-moved`; with `compat` `lumped-away`; `not-for-format` for `compat` in
    SDF, where libsdformat lumps nothing.
    """

    name: ClassVar[str] = "lump-fixed-joints"
    example: ClassVar[str] = "lump-fixed-joints{keep=[tool0,*_optical_frame]}"

    keep: tuple[str, ...] = Field(default=(), description=with_such_a_name("Links and joints that stay,"))
    compat: Literal["libsdformat"] | None = Field(default=None, description="The program whose rules are followed.")

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with one body for each group of links that cannot move against each other."""
        # imported here: a document needs one way only
        if self.compat is not None:
            if place.format is Format.SDF:
                message = f"libsdformat does not lump joints of SDF; model {model.name!r} is left unchanged"
                place.sink.report(rules.NOT_FOR_FORMAT, message, model.location, found=self.compat)
                return model
            from twinform.passes.structure.lump_as_libsdformat import lump_as_libsdformat  # noqa: PLC0415 - see above

            return lump_as_libsdformat(model, self.keep, place)
        if place.format is Format.SDF:
            from twinform.passes.structure.lump_sdf import lump_sdf  # noqa: PLC0415 - see above

            return lump_sdf(model, self.keep, place, Meshes(self._assets))
        from twinform.passes.structure.lump_urdf import lump_urdf  # noqa: PLC0415 - see above

        return lump_urdf(model, self.keep, place)
