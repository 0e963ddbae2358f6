"""Selection of the passes between two versions of SDF."""

from collections.abc import Callable, Iterator

from twinform.passes.framework.base import Pass
from twinform.passes.sdf_versions.bound_limits import BoundLimits
from twinform.passes.sdf_versions.clear_names import ClearNames
from twinform.passes.sdf_versions.connect_links import ConnectLinks
from twinform.passes.sdf_versions.fit_joint_types import FitJointTypes
from twinform.passes.sdf_versions.flatten_nested import FlattenNested
from twinform.passes.sdf_versions.leave_out import LeaveOut
from twinform.passes.sdf_versions.move_time_steps import MoveTimeSteps
from twinform.passes.sdf_versions.move_world_fields import MoveWorldFields
from twinform.passes.sdf_versions.name_axis_frames import NameAxisFrames
from twinform.passes.sdf_versions.name_pose_frames import NamePoseFrames
from twinform.passes.sdf_versions.name_the_nameless import NameTheNameless
from twinform.passes.sdf_versions.nest_models import NestModels
from twinform.passes.sdf_versions.place_absolutely import PlaceAbsolutely
from twinform.passes.sdf_versions.place_inertials import PlaceInertials
from twinform.passes.sdf_versions.rename_states import RenameStates
from twinform.passes.sdf_versions.spread_imu_noise import GatherImuNoise, SpreadImuNoise
from twinform.passes.sdf_versions.turn_axes import TurnAxes
from twinform.passes.sdf_versions.write_inertias import WriteInertias
from twinform.passes.sdf_versions.write_plain_poses import WritePlainPoses
from twinform.passes.sdf_versions.write_thread_pitches import WriteThreadPitches
from twinform.schemas import Version, print_version

Crosses = Callable[[int], bool]
"""Whether a minor version, with which something came, lies between the two."""


def forward(old: Version, new: Version, *, names: bool = True, mixed: bool = False) -> Iterator[Pass]:
    """The passes from an older version to a newer one, each where its version is crossed.

    `names` says whether names become what newer versions want: unlike each other, and without scopes in them; `mixed`
    whether the file has newer syntax already.
    """
    crosses: Crosses = lambda minor: old < (1, minor) <= new  # noqa: E731 - a word for the lines below
    yield from _to_named_frames(crosses, print_version(new), old, names=names, mixed=mixed)
    yield from _from_named_frames(crosses, print_version(new), names=names)


def _to_named_frames(crosses: Crosses, version: str, old: Version, *, names: bool, mixed: bool) -> Iterator[Pass]:
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
        yield NameAxisFrames(version=version, source_before_1_5=old < (1, 5), both=mixed)
    if crosses(7) and names:
        yield ClearNames(version=version)


def _from_named_frames(crosses: Crosses, version: str, *, names: bool) -> Iterator[Pass]:
    if crosses(8):
        yield PlaceInertials(version=version)
    if crosses(8) and names:
        yield NestModels(version=version)
    if crosses(10):
        yield WriteThreadPitches(version=version)
    if crosses(12):
        yield RenameStates(version=version)


def unversioned(version: str, *, carriers: bool = True) -> Iterator[Pass]:
    """The passes for words of any version in a text that declares none, where no newer version means something else."""
    yield SpreadImuNoise(version=version, mark=carriers)
    yield NamePoseFrames(version=version)
    yield NameAxisFrames(version=version)


def backward(new: Version, old: Version, *, carriers: bool = True) -> Iterator[Pass]:
    """The passes from a newer version to an older one, each where its version is crossed."""
    crosses: Crosses = lambda minor: old < (1, minor) <= new  # noqa: E731 - a word for the lines below
    yield from _models_back(crosses, print_version(old), print_version(new), carriers=carriers)
    yield from _values_back(crosses, print_version(old), carriers=carriers)
    yield LeaveOut(version=print_version(old), carriers=carriers)


def meaning_back(new: Version, old: Version) -> Iterator[Pass]:
    """The passes from a newer version to an older one for words that both have, and that mean something else there."""
    crosses: Crosses = lambda minor: old < (1, minor) <= new  # noqa: E731 - a word for the lines below
    version = print_version(old)
    if crosses(5):
        yield TurnAxes(version=version)
    if crosses(6):
        yield GatherImuNoise(version=version)
    if crosses(10):
        yield BoundLimits(version=version)
    if crosses(4):
        yield MoveTimeSteps(version=version, back=True)


def _models_back(crosses: Crosses, version: str, source: str, *, carriers: bool) -> Iterator[Pass]:
    """What is where, from the outside in."""
    if crosses(12):
        yield RenameStates(version=version, carriers=carriers, back=True)
    if crosses(11):
        yield WriteInertias(version=version, carriers=carriers)
    if crosses(5):
        yield FlattenNested(version=version, carriers=carriers, source=source)
    if crosses(8):
        yield ConnectLinks(version=version, carriers=carriers)
    if crosses(7) or crosses(5):
        yield TurnAxes(version=version, carriers=carriers)
    if crosses(8) or crosses(7):
        yield PlaceAbsolutely(version=version, carriers=carriers)


def _values_back(crosses: Crosses, version: str, *, carriers: bool) -> Iterator[Pass]:
    """How it is written."""
    if crosses(9):
        yield WritePlainPoses(version=version, carriers=carriers)
    if any(map(crosses, (4, 5, 6))):
        yield FitJointTypes(version=version, carriers=carriers)
    if crosses(10):
        yield BoundLimits(version=version, carriers=carriers)
        yield WriteThreadPitches(version=version, carriers=carriers, back=True)
        yield NameTheNameless(version=version, carriers=carriers)
    if crosses(6):
        yield GatherImuNoise(version=version, carriers=carriers)
        yield MoveWorldFields(version=version, carriers=carriers, back=True)
    if crosses(4):
        yield MoveTimeSteps(version=version, carriers=carriers, back=True)
