"""Fix a robot to the world."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import rules
from twinform.ir import Format, Joint, Link, Model, Pose
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.reroot import joints_to_root


class WeldToWorld(ModelEdit):
    """Fix the base of a robot to the world, where it is or at a pose.

    Changes: 1. in URDF a link `world` becomes the root, and a fixed joint holds the old root there; 2. in SDF a fixed
    joint holds the root of the canonical link to `world`, and the model is posed so that this link is at the pose, if
    one is given.
    Never touches: models that are static or held already, joints and links of the robot.
    Diagnostics: `already-held`; `name-clash` where the joint's name is taken, or `world` is a link inside the robot.
    """

    name: ClassVar[str] = "weld-to-world"
    example: ClassVar[str] = "weld-to-world{xyz=[0,0,0.5]}"

    xyz: Vector3 | None = Field(default=None, description="Where the base is in the world, in m.")
    rpy: Vector3 | None = Field(default=None, description="How it is turned: roll, pitch and yaw in rad.")
    joint: str = Field(default="world_joint", min_length=1, description="The name of the joint.")

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with its base held."""
        if not model.links:
            return model
        base = _free_base(model)
        if model.static or base is None:
            message = f"model {model.name!r} is {'static' if model.static else 'fixed to the world'} already"
            place.sink.report(rules.ALREADY_HELD, message, model.location, found=model.name)
            return model
        if self._report_clashes(model, place):
            return model
        return self._weld_urdf(model, base) if place.format is Format.URDF else self._weld_sdf(model, base)

    def _report_clashes(self, model: Model, place: EditContext) -> bool:
        siblings = (*model.joints, *((*model.links, *model.frames) if place.format is Format.SDF else ()))
        other = next((each for each in siblings if each.name == self.joint), None)
        world = next((link for link in model.links if link.name == WORLD), None)
        for node, name in ((other, self.joint), (world, WORLD)):
            if node is not None:
                message = f"{name!r} is the name of another part of model {model.name!r}"
                place.sink.report(rules.NAME_CLASH, message, node.location, found=name)
        return other is not None or world is not None

    def _weld_urdf(self, model: Model, base: str) -> Model:
        pose = Pose(xyz=self.xyz, rpy=self.rpy, relative_to=WORLD)
        joint = Joint(name=self.joint, type="fixed", parent=WORLD, child=base, pose=pose)
        held = Pose(relative_to=self.joint)
        links = tuple(link.copy(pose=held) if link.name == base else link for link in model.links)
        return model.copy(links=(Link(name=WORLD), *links), joints=(joint, *model.joints))

    def _weld_sdf(self, model: Model, base: str) -> Model:
        joint = Joint(name=self.joint, type="fixed", parent=WORLD, child=base)
        made = model.copy(joints=(*model.joints, joint))
        if self.xyz is None and self.rpy is None:
            return made
        wanted = Transform.from_pose(Pose(xyz=self.xyz, rpy=self.rpy))
        inside = FrameGraph(model).pose(base, MODEL, base="model")
        pose = wanted.compose(inside.inverse()).to_pose()
        return made.copy(pose=pose, placement_frame=None)


def _free_base(model: Model) -> str | None:
    """The link that all others hang from; None where that is the world."""
    body = FrameGraph(model).body(MODEL, kind="model")
    way = joints_to_root(model, body)
    base = way[-1][1] if way else body
    return None if base == WORLD else base
