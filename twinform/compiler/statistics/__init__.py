"""Statistics of models: counts, sizes, masses and the cost of meshes."""

from twinform.compiler.statistics.collect_statistics import FileStatistics, WorldStatistics, measure
from twinform.compiler.statistics.mesh_costs import MeshCost
from twinform.compiler.statistics.model import ModelStatistics
from twinform.compiler.statistics.statistics_reporters import REPORTERS

__all__ = ["REPORTERS", "FileStatistics", "MeshCost", "ModelStatistics", "WorldStatistics", "measure"]
