"""Names of joints that links have too, as SDF before 1.7 allows."""

from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Format, Joint, Model
from twinform.passes.legalise.changed_names import Names, renamed, with_old_name
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.nodes import reserve_name


class NameJointsApart(ToUrdfPass):
    """Give joints names that no link has.

    Changes: a joint with the name of a link becomes `NAME_joint`, as it does where libsdformat reads such an SDF file;
    it refuses a URDF in which they share a name. What names the joint follows.
    Never touches: names that a URDF gave.
    Diagnostics: `renamed`. The old name is carried.
    """

    name: ClassVar[str] = "name-joints-apart"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with one name for each link and joint."""
        links = {link.name for link in model.links}
        clashes = [joint.name for joint in model.joints if joint.name in links]
        if keeper.back or not clashes:
            return model
        taken = links | {joint.name for joint in model.joints}
        # Model.cc (Load) renames the joint of an SDF file before 1.7 in the same way, so the URDF has the
        # name that Gazebo has for the joint of the source.
        new = {name: reserve_name(f"{name}_joint", taken) for name in clashes}
        names: Names = {("joint", old): made for old, made in new.items()}
        joints = tuple(self._rename_joint(joint, new, keeper) if joint.name in new else joint for joint in model.joints)
        return renamed(model.copy(joints=joints), names, Format.URDF)

    def _rename_joint(self, joint: Joint, new: dict[str, str], keeper: UrdfKeeper) -> Joint:
        message = f"joint {joint.name!r} is called {new[joint.name]!r} in URDF: a link has its name"
        keeper.sink.report(rules.RENAMED, message, joint.location, found=joint.name)
        keeper.account(rules.RENAMED, message, joint.location.at("@name"), 1)
        return with_old_name(joint, new[joint.name]) if self.carriers else joint
