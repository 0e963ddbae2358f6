"""Statistics of models: counts, sizes, masses and the cost of meshes."""

from twinform.compiler.statistics.collect_statistics import FileStatistics, ModelStatistics, WorldStatistics, measure
from twinform.compiler.statistics.costs import MeshCost
from twinform.compiler.statistics.statistics_reporters import REPORTERS

__all__ = ["REPORTERS", "FileStatistics", "MeshCost", "ModelStatistics", "WorldStatistics", "measure"]
