"""The passes between versions of SDF by their classes, each imported when it is used: few conversions need many."""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.passes.sdf_versions.bound_limits import BoundLimits
    from twinform.passes.sdf_versions.clear_names import ClearNames
    from twinform.passes.sdf_versions.connect_links import ConnectLinks
    from twinform.passes.sdf_versions.fit_joint_types import FitJointTypes
    from twinform.passes.sdf_versions.leave_out import LeaveOut
    from twinform.passes.sdf_versions.move_elements import MoveTimeSteps, MoveWorldFields
    from twinform.passes.sdf_versions.name_frames import NameAxisFrames, NamePoseFrames
    from twinform.passes.sdf_versions.name_the_nameless import NameTheNameless
    from twinform.passes.sdf_versions.nest_models import FlattenNested, NestModels
    from twinform.passes.sdf_versions.place_absolutely import PlaceAbsolutely
    from twinform.passes.sdf_versions.place_inertials import PlaceInertials
    from twinform.passes.sdf_versions.rename_states import RenameStates
    from twinform.passes.sdf_versions.replace_shapes import FoldCapsules, FoldShapeMeshes, ReplaceShapes
    from twinform.passes.sdf_versions.spread_imu_noise import GatherImuNoise, SpreadImuNoise
    from twinform.passes.sdf_versions.turn_axes import TurnAxes
    from twinform.passes.sdf_versions.write_inertias import WriteInertias
    from twinform.passes.sdf_versions.write_plain_poses import WritePlainPoses
    from twinform.passes.sdf_versions.write_thread_pitches import WriteThreadPitches
# A conversion within one version imports none of these modules, and one from 1.6 to 1.11 a handful:
# the start of the command depends on it.
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.passes.sdf_versions.bound_limits": "BoundLimits",
            "twinform.passes.sdf_versions.clear_names": "ClearNames",
            "twinform.passes.sdf_versions.connect_links": "ConnectLinks",
            "twinform.passes.sdf_versions.fit_joint_types": "FitJointTypes",
            "twinform.passes.sdf_versions.nest_models": "FlattenNested NestModels",
            "twinform.passes.sdf_versions.leave_out": "LeaveOut",
            "twinform.passes.sdf_versions.move_elements": "MoveTimeSteps MoveWorldFields",
            "twinform.passes.sdf_versions.name_frames": "NameAxisFrames NamePoseFrames",
            "twinform.passes.sdf_versions.name_the_nameless": "NameTheNameless",
            "twinform.passes.sdf_versions.place_absolutely": "PlaceAbsolutely",
            "twinform.passes.sdf_versions.place_inertials": "PlaceInertials",
            "twinform.passes.sdf_versions.rename_states": "RenameStates",
            "twinform.passes.sdf_versions.replace_shapes": "FoldCapsules FoldShapeMeshes ReplaceShapes",
            "twinform.passes.sdf_versions.spread_imu_noise": "GatherImuNoise SpreadImuNoise",
            "twinform.passes.sdf_versions.turn_axes": "TurnAxes",
            "twinform.passes.sdf_versions.write_inertias": "WriteInertias",
            "twinform.passes.sdf_versions.write_plain_poses": "WritePlainPoses",
            "twinform.passes.sdf_versions.write_thread_pitches": "WriteThreadPitches",
        },
    )

__all__ = [
    "BoundLimits",
    "ClearNames",
    "ConnectLinks",
    "FitJointTypes",
    "FlattenNested",
    "FoldCapsules",
    "FoldShapeMeshes",
    "GatherImuNoise",
    "LeaveOut",
    "MoveTimeSteps",
    "MoveWorldFields",
    "NameAxisFrames",
    "NamePoseFrames",
    "NameTheNameless",
    "NestModels",
    "PlaceAbsolutely",
    "PlaceInertials",
    "RenameStates",
    "ReplaceShapes",
    "SpreadImuNoise",
    "TurnAxes",
    "WriteInertias",
    "WritePlainPoses",
    "WriteThreadPitches",
]
