"""From SDF's terms to URDF's, step by step."""

from twinform.passes.base import Pass
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.build_tree import BuildTree
from twinform.passes.legalise.to_urdf.carry_the_rest import CarryTheRest
from twinform.passes.legalise.to_urdf.express_axes import ExpressAxes
from twinform.passes.legalise.to_urdf.extend_gazebo import ExtendGazebo
from twinform.passes.legalise.to_urdf.fill_inertials import FillInertials
from twinform.passes.legalise.to_urdf.flatten_models import FlattenModels
from twinform.passes.legalise.to_urdf.map_geometry import MapGeometry
from twinform.passes.legalise.to_urdf.map_joints import MapJoints
from twinform.passes.legalise.to_urdf.map_materials import MapMaterials
from twinform.passes.legalise.to_urdf.map_surfaces import MapSurfaces
from twinform.passes.legalise.to_urdf.rebase_links import RebaseLinks
from twinform.passes.legalise.to_urdf.resolve_joint_ends import ResolveJointEnds
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.passes.legalise.to_urdf.turn_frames_into_links import TurnFramesIntoLinks
from twinform.passes.legalise.to_urdf.upgrade_sdf import UpgradeSdf

__all__ = ["PIPELINE", "pipeline"]

_STEPS: tuple[type[ToUrdfPass], ...] = (
    UpgradeSdf,
    FlattenModels,
    FillInertials,
    ResolveJointEnds,
    ExpressAxes,
    TurnFramesIntoLinks,
    BuildTree,
    MapGeometry,
    MapMaterials,
    MapSurfaces,
    MapJoints,
    RebaseLinks,
    ExtendGazebo,
)

PIPELINE: tuple[type[Pass], ...] = (SelectModel, *_STEPS, CarryTheRest)
"""The passes in the order in which they run."""


def pipeline(*, model: str | None = None, carriers: bool = True) -> tuple[Pass, ...]:
    """The passes that make URDF of the model of this name, or of the only one."""
    steps = (step(carriers=carriers) for step in _STEPS)
    return (SelectModel(model=model), *steps, CarryTheRest(carriers=carriers))
