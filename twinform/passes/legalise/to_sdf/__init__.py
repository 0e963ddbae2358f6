"""From the terms of URDF to those of SDF: the passes, in order."""

from twinform.passes.base import Pass
from twinform.passes.legalise.sdf_versions import lower_version, raise_unversioned
from twinform.passes.legalise.to_sdf.bodies import UrdfBodies
from twinform.passes.legalise.to_sdf.carry_urdf import CarryUrdf
from twinform.passes.legalise.to_sdf.declare_quaternions import DeclareQuaternions
from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo
from twinform.passes.legalise.to_sdf.fold_gearboxes import FoldGearboxes
from twinform.passes.legalise.to_sdf.fold_joints import FoldJoints
from twinform.passes.legalise.to_sdf.frame_links import FrameLinks
from twinform.passes.legalise.to_sdf.joints import UrdfJoints
from twinform.passes.legalise.to_sdf.leave_inertias import LeaveInertias
from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris
from twinform.passes.legalise.to_sdf.name_shapes import NameShapes
from twinform.passes.legalise.to_sdf.retarget import RetargetSdf
from twinform.passes.legalise.to_sdf.shared_materials import SharedMaterials
from twinform.passes.legalise.to_sdf.unique_names import UniqueNames
from twinform.passes.legalise.to_sdf.unpack_sdf import UnpackSdf
from twinform.passes.legalise.to_sdf.world_link import WorldLink

__all__ = ["to_sdf"]


def to_sdf(version: str, *, carriers: bool) -> tuple[Pass, ...]:
    """The passes that make SDF of a version out of a URDF document."""
    return (
        CarryUrdf(carriers=carriers),  # before anything of SDF comes in
        FoldGazebo(carriers=carriers),
        *raise_unversioned(),
        FoldJoints(),
        LeaveInertias(version=version),
        WorldLink(carriers=carriers),
        UniqueNames(carriers=carriers),
        NameShapes(),
        SharedMaterials(carriers=carriers),
        FrameLinks(carriers=carriers),
        UrdfBodies(),
        UrdfJoints(carriers=carriers),
        FoldGearboxes(),
        UnpackSdf(carriers=carriers),  # when all that URDF says is said
        MeshUris(),
        DeclareQuaternions(),
        *lower_version(None, version, carriers=carriers),
        RetargetSdf(version=version),
    )
