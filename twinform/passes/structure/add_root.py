"""Add a root link without mass above one that has an inertia."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import rules
from twinform.ir import Format, Joint, Link, Model, Pose
from twinform.passes.structure.model_edit import EditContext, ModelEdit


class AddRoot(ModelEdit):
    """Put a link without mass above a root link of URDF that has an inertia, which KDL would leave out.

    Changes: 1. a link without mass becomes the root; 2. a fixed joint holds the old root there, at the same place.
    Never touches: a root without an inertia, other links and joints, and SDF, where a link without mass falls apart.
    Diagnostics: `name-clash` where a name is taken.
    """

    name: ClassVar[str] = "add-root"
    example: ClassVar[str] = "add-root{link=base_footprint}"

    link: str = Field(default="base_footprint", min_length=1, description="The name of the new root.")
    joint: str = Field(
        default="base_footprint_joint", min_length=1, description="The name of the joint that holds the old root."
    )

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with a root that weighs nothing."""
        held = {joint.child for joint in model.joints}
        roots = [link for link in model.links if link.name not in held]
        if place.format is not Format.URDF or len(roots) != 1 or roots[0].inertial is None:
            return model
        taken = [link for link in model.links if link.name == self.link]
        clashes = [*taken, *(joint for joint in model.joints if joint.name == self.joint)]
        for each in clashes:
            message = f"{each.name!r} is the name of another part of model {model.name!r}"
            place.sink.report(rules.NAME_CLASH, message, each.location, found=each.name)
        return model if clashes else self._with_root(model, roots[0])

    def _with_root(self, model: Model, old: Link) -> Model:
        pose = Pose(relative_to=self.link)
        joint = Joint(name=self.joint, type="fixed", parent=self.link, child=old.name, pose=pose)
        links = tuple(link.copy(pose=Pose(relative_to=self.joint)) if link is old else link for link in model.links)
        return model.copy(links=(Link(name=self.link), *links), joints=(joint, *model.joints))
