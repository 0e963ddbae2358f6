"""Legalisation from SDF to URDF: the passes, in order."""

from twinform.ir import Format
from twinform.passes.carriers.misplaced import DropMisplaced
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.automatic_inertias import ComputeInertias
from twinform.passes.legalise.carried_urdf import UnpackUrdf
from twinform.passes.legalise.changed_names import NameJointsApart, RestoreNames
from twinform.passes.legalise.drake_joints import WriteDrakeJoints
from twinform.passes.legalise.drop_stale import DropStale
from twinform.passes.legalise.fit_urdf_version import FitUrdfVersion
from twinform.passes.legalise.frame_links import TurnFramesIntoLinks
from twinform.passes.legalise.free_links import PlaceFreeLinks
from twinform.passes.legalise.gearboxes import RelateGearboxes
from twinform.passes.legalise.joint_notation import ExpressAxes, ResolveJointEnds
from twinform.passes.legalise.lumped_names import RestoreLumpedNames
from twinform.passes.legalise.nested_models import FlattenForUrdf
from twinform.passes.legalise.round_tiny_numbers import RoundTinyNumbers
from twinform.passes.legalise.scoped_elements import ShowScopedElements
from twinform.passes.legalise.shape_names import NameShapesForGazebo
from twinform.passes.legalise.shared_inertias import RestoreInertias
from twinform.passes.legalise.shared_materials import RestoreMaterials
from twinform.passes.legalise.to_urdf.build_tree import BuildTree
from twinform.passes.legalise.to_urdf.carry_the_rest import CarryTheRest
from twinform.passes.legalise.to_urdf.extend_gazebo import ExtendGazebo
from twinform.passes.legalise.to_urdf.fold_planar_joints import FoldPlanarJoints
from twinform.passes.legalise.to_urdf.map_geometry import AddCapsuleEnds, MapGeometry
from twinform.passes.legalise.to_urdf.map_joints import MapJoints
from twinform.passes.legalise.to_urdf.map_materials import MapMaterials
from twinform.passes.legalise.to_urdf.map_surfaces import MapSurfaces
from twinform.passes.legalise.to_urdf.rebase_links import RebaseLinks
from twinform.passes.legalise.to_urdf.restore_links import RestoreLinks
from twinform.passes.legalise.to_urdf.restore_shapes import RestoreShapes
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.passes.legalise.to_urdf.share_visuals import ShareVisuals
from twinform.passes.legalise.to_urdf.unfold_joints import UnfoldJoints
from twinform.passes.legalise.to_urdf.upgrade_sdf import UpgradeSdf
from twinform.passes.legalise.unwritten_masses import FillInertials
from twinform.passes.legalise.world_link import RestoreWorldLink
from twinform.passes.sdf_versions.replace_shapes import FoldCapsules, FoldShapeMeshes
from twinform.passes.sdf_versions.spread_imu_noise import GatherImuNoise
from twinform.request_options import USUAL, Requested, UrdfVersion
from twinform.schemas import versions_of

__all__ = ["to_urdf"]


def to_urdf(
    urdf_version: UrdfVersion = "1.0",
    requested: Requested = USUAL,
    *,
    mixed: bool = False,
    mixed_source: bool = False,
) -> tuple[Pass, ...]:
    """The passes that make URDF of a version out of the requested model, or of the only one.

    `mixed` lets it have elements of newer versions, and `mixed_source` means that the SDF has syntax of other ones.
    """
    carriers = requested.carriers
    words: UrdfVersion = "1.2" if mixed else urdf_version
    return (
        # URDF holds one robot.
        SelectModel.unchecked(model=requested.model),
        DropMisplaced.unchecked(),
        FoldCapsules.unchecked(),
        FoldShapeMeshes.unchecked(),
        ShowScopedElements.unchecked(),
        UpgradeSdf.unchecked(carriers=carriers, mixed=mixed_source),
        GatherImuNoise.unchecked(version=versions_of("sdf")[-1], annotated=True),
        FlattenForUrdf.unchecked(carriers=carriers),
        FoldPlanarJoints.unchecked(carriers=carriers),
        # Inertias first: shapes that URDF lacks leave their links further below, and count for an
        # automatic inertia.
        ComputeInertias.unchecked(carriers=carriers),
        FillInertials.unchecked(carriers=carriers),
        RestoreLinks.unchecked(carriers=carriers),
        ResolveJointEnds.unchecked(carriers=carriers),
        ExpressAxes.unchecked(carriers=carriers),
        # Frames before the tree: a frame that an edit put into a circle is fixed to its link first,
        # and the joint of the edit is the one that is cut.
        TurnFramesIntoLinks.unchecked(carriers=carriers),
        BuildTree.unchecked(carriers=carriers),
        # After the tree, which says which joint holds each link.
        RelateGearboxes.unchecked(carriers=carriers),
        UnfoldJoints.unchecked(carriers=carriers),
        MapJoints.unchecked(carriers=carriers, urdf_version=urdf_version),
        RebaseLinks.unchecked(carriers=carriers, urdf_version=urdf_version),
        MapGeometry.unchecked(  # what it carries is where it will be
            carriers=carriers,
            urdf_version=words,
            shape_error=requested.shape_error,
            mesh_prefix=requested.mesh_prefix,
            side_files=requested.side_files,
        ),
        ShareVisuals.unchecked(carriers=carriers, urdf_version=words),
        MapMaterials.unchecked(carriers=carriers),
        MapSurfaces.unchecked(carriers=carriers),
        NameJointsApart.unchecked(carriers=carriers),  # before <gazebo> names them
        ExtendGazebo.unchecked(carriers=carriers),
        CarryTheRest.unchecked(carriers=carriers, urdf_version=urdf_version, words=words),
        AddCapsuleEnds.unchecked(carriers=carriers),
        NameShapesForGazebo.unchecked(carriers=carriers),
        RestoreMaterials.unchecked(),
        RestoreShapes.unchecked(),
        RestoreWorldLink.unchecked(carriers=carriers),  # after shapes, whose made names have that of their link
        RestoreNames.unchecked(to=Format.URDF),
        RestoreLumpedNames.unchecked(),
        UnpackUrdf.unchecked(urdf_version=urdf_version),
        RestoreInertias.unchecked(),
        WriteDrakeJoints.unchecked(),
        PlaceFreeLinks.unchecked(carriers=carriers),
        # What came back from an older URDF begins to mean something.
        *(() if urdf_version == "1.0" else (FitUrdfVersion.unchecked(version=urdf_version),)),
        # Last: whatever carrier nobody has taken by now fits nothing any more.
        DropStale.unchecked(to=Format.URDF),
        RoundTinyNumbers.unchecked(to=Format.URDF),
    )
