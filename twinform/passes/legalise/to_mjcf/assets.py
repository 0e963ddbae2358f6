"""Assets of MJCF: meshes and height fields, one for each file and scale."""

from twinform.ir.geometry import Mesh
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext


def mesh_asset(context: MjcfContext, mesh: Mesh) -> str | None:
    """The name of the asset of a mesh; None where MuJoCo cannot read it."""
    del context, mesh
    return None
