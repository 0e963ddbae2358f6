"""Legalisation from URDF to SDF: the passes, in order."""

from twinform.ir import Format
from twinform.passes.carriers.misplaced import DropMisplaced
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.automatic_inertias import LeaveInertias
from twinform.passes.legalise.carried_urdf import CarryUrdf
from twinform.passes.legalise.changed_names import RestoreNames, UniqueNames
from twinform.passes.legalise.drake_joints import ReadDrakeJoints
from twinform.passes.legalise.drop_stale import DropStale
from twinform.passes.legalise.frame_links import FrameLinks
from twinform.passes.legalise.free_links import FreeStaticModels
from twinform.passes.legalise.gearboxes import FoldGearboxes
from twinform.passes.legalise.joint_notation import RestoreJoints
from twinform.passes.legalise.lumped_names import FollowLumpedNames
from twinform.passes.legalise.nested_models import NameScopes, RestoreNested
from twinform.passes.legalise.round_tiny_numbers import RoundTinyNumbers
from twinform.passes.legalise.scoped_elements import HideScopedElements
from twinform.passes.legalise.shape_names import NameShapes, RestoreShapeNames
from twinform.passes.legalise.shared_inertias import ShareInertias
from twinform.passes.legalise.shared_materials import SharedMaterials
from twinform.passes.legalise.to_sdf.close_loops import CloseLoops
from twinform.passes.legalise.to_sdf.declare_quaternions import DeclareQuaternions
from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo
from twinform.passes.legalise.to_sdf.fold_joints import FoldJoints
from twinform.passes.legalise.to_sdf.joint_types import UrdfJoints
from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris
from twinform.passes.legalise.to_sdf.note_lumping import NoteLumping
from twinform.passes.legalise.to_sdf.restore_frames import RestoreFrames
from twinform.passes.legalise.to_sdf.retarget import RetargetSdf
from twinform.passes.legalise.to_sdf.unpack_sdf import UnpackSdf
from twinform.passes.legalise.unwritten_masses import UrdfBodies
from twinform.passes.legalise.world_link import WorldLink
from twinform.passes.sdf_versions import lower_meaning, lower_version, raise_unversioned
from twinform.passes.sdf_versions.replace_shapes import FoldCapsules, FoldShapeMeshes
from twinform.request_options import USUAL, Requested
from twinform.schemas import parse_version

__all__ = ["to_sdf"]

_ONE_SCOPE = (1, 7)
"""Since this version all names in a model are unlike each other."""
_NAMES_MEAN_MODELS = (1, 8)
"""Since this version `::` in a name means that it is in a nested model."""


def to_sdf(
    version: str,
    requested: Requested = USUAL,
    *,
    mixed: bool = False,
    mixed_source: bool = False,
    scopes: bool = True,
) -> tuple[Pass, ...]:
    """The passes that make SDF of a version out of a URDF document.

    `mixed` lets it have syntax of newer versions, and `mixed_source` is for a URDF that has some. Without `scopes`,
    `::` in a name that a file before 1.8 gave is no model since 1.8 either, as where such a file is compared.
    """
    carriers = requested.carriers
    before_named_frames = parse_version(version) < _ONE_SCOPE
    return (
        DropMisplaced.unchecked(),
        # The numbers in names of libsdformat count all shapes, those at the ends of capsules too.
        RestoreShapeNames.unchecked(),
        FollowLumpedNames.unchecked(carriers=carriers),
        FoldCapsules.unchecked(),
        ReadDrakeJoints.unchecked(carriers=carriers),
        CarryUrdf.unchecked(carriers=carriers),  # before anything of SDF comes in
        FoldShapeMeshes.unchecked(),
        CloseLoops.unchecked(carriers=carriers),
        ShareInertias.unchecked(carriers=carriers),
        NoteLumping.unchecked(),
        FoldGazebo.unchecked(carriers=carriers),
        *raise_unversioned(carriers=carriers),
        UnpackSdf.unchecked(of="bodies"),
        FoldJoints.unchecked(),
        LeaveInertias.unchecked(version=version),
        FreeStaticModels.unchecked(),
        WorldLink.unchecked(carriers=carriers),
        UniqueNames.unchecked(carriers=carriers),
        NameShapes.unchecked(carriers=carriers),
        SharedMaterials.unchecked(carriers=carriers),
        FrameLinks.unchecked(carriers=carriers),
        UrdfBodies.unchecked(carriers=carriers),
        UrdfJoints.unchecked(carriers=carriers),
        RestoreJoints.unchecked(),
        FoldGearboxes.unchecked(),
        UnpackSdf.unchecked(of="parts"),  # when all that URDF has is in its place
        MeshUris.unchecked(carriers=carriers),
        RestoreNames.unchecked(to=Format.SDF),
        NameScopes.unchecked(),
        RestoreFrames.unchecked(old_words=mixed and before_named_frames),
        UnpackSdf.unchecked(of="repeated-poses"),  # when it is known where the first one is
        RestoreNested.unchecked(scopes=scopes and parse_version(version) >= _NAMES_MEAN_MODELS),
        DropStale.unchecked(to=Format.SDF),
        DeclareQuaternions.unchecked(),
        RoundTinyNumbers.unchecked(to=Format.SDF),  # when no more is computed
        # A robot whose SDF had syntax of newer versions goes back to such a file: only what means
        # something else in its version is rewritten.
        *(lower_meaning(version) if mixed else lower_version(None, version, requested)),
        *([RestoreNames.unchecked(to=Format.SDF, apart=True)] if before_named_frames else []),
        *([HideScopedElements.unchecked(carriers=carriers)] if parse_version(version) >= _NAMES_MEAN_MODELS else []),
        RetargetSdf.unchecked(version=version, carriers=carriers, mixed=mixed_source),
    )
