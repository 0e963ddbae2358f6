"""Which passes lie between two versions of SDF."""

from collections.abc import Iterator

from twinform.passes.base import Pass
from twinform.passes.legalise.sdf_versions.bound_limits import BoundLimits
from twinform.passes.legalise.sdf_versions.clear_names import ClearNames
from twinform.passes.legalise.sdf_versions.connect_links import ConnectLinks
from twinform.passes.legalise.sdf_versions.fit_joint_types import FitJointTypes
from twinform.passes.legalise.sdf_versions.flatten_nested import FlattenNested
from twinform.passes.legalise.sdf_versions.leave_out import LeaveOut
from twinform.passes.legalise.sdf_versions.move_time_steps import MoveTimeSteps
from twinform.passes.legalise.sdf_versions.move_world_fields import MoveWorldFields
from twinform.passes.legalise.sdf_versions.name_axis_frames import NameAxisFrames
from twinform.passes.legalise.sdf_versions.name_pose_frames import NamePoseFrames
from twinform.passes.legalise.sdf_versions.name_the_nameless import NameTheNameless
from twinform.passes.legalise.sdf_versions.nest_models import NestModels
from twinform.passes.legalise.sdf_versions.place_absolutely import PlaceAbsolutely
from twinform.passes.legalise.sdf_versions.place_inertials import PlaceInertials
from twinform.passes.legalise.sdf_versions.rename_states import RenameStates
from twinform.passes.legalise.sdf_versions.spread_imu_noise import SpreadImuNoise
from twinform.passes.legalise.sdf_versions.turn_axes import TurnAxes
from twinform.passes.legalise.sdf_versions.write_plain_poses import WritePlainPoses
from twinform.passes.legalise.sdf_versions.write_thread_pitches import WriteThreadPitches
from twinform.schemas import Version, print_version


def forward(old: Version, new: Version, *, names: bool = True) -> Iterator[Pass]:
    """The passes from an older version to a newer one, each where its version is crossed.

    `names` says whether names become what newer versions want: unlike each other, and without scopes in them.
    """
    version = print_version(new)

    def crosses(minor: int) -> bool:
        return old < (1, minor) <= new

    if crosses(4):
        yield MoveTimeSteps(version=version)
    if crosses(5):
        yield FitJointTypes(version=version)
    if crosses(6):
        yield MoveWorldFields(version=version)
        yield SpreadImuNoise(version=version)
        yield NameTheNameless(version=version)
    if crosses(7):
        yield NamePoseFrames(version=version)
    if crosses(5) or crosses(7):
        yield NameAxisFrames(version=version, source_before_1_5=old < (1, 5))
    if crosses(7) and names:
        yield ClearNames(version=version)
    if crosses(8):
        yield PlaceInertials(version=version)
        if names:
            yield NestModels(version=version)
    if crosses(10):
        yield WriteThreadPitches(version=version)
    if crosses(12):
        yield RenameStates(version=version)


def backward(new: Version, old: Version, *, carriers: bool = True) -> Iterator[Pass]:
    """The passes from a newer version to an older one, each where its version is crossed."""
    version = print_version(old)

    def crosses(minor: int) -> bool:
        return old < (1, minor) <= new

    if crosses(12):
        yield RenameStates(version=version, carriers=carriers, back=True)
    if crosses(5):
        yield FlattenNested(version=version, carriers=carriers, source=print_version(new))
    if crosses(8):
        yield ConnectLinks(version=version, carriers=carriers)
    if crosses(7) or crosses(5):
        yield TurnAxes(version=version, carriers=carriers)
    if crosses(8) or crosses(7):
        yield PlaceAbsolutely(version=version, carriers=carriers)
    if crosses(9):
        yield WritePlainPoses(version=version, carriers=carriers)
    if crosses(6) or crosses(5) or crosses(4):
        yield FitJointTypes(version=version, carriers=carriers)
    if crosses(10):
        yield BoundLimits(version=version, carriers=carriers)
        yield WriteThreadPitches(version=version, carriers=carriers, back=True)
        yield NameTheNameless(version=version, carriers=carriers)
    if crosses(6):
        yield MoveWorldFields(version=version, carriers=carriers, back=True)
    if crosses(4):
        yield MoveTimeSteps(version=version, carriers=carriers, back=True)
    yield LeaveOut(version=version, carriers=carriers)
