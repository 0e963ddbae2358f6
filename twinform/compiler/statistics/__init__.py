"""Statistics of models: counts, sizes, masses and the cost of meshes."""

from twinform.compiler.statistics.driver import FileStatistics, WorldStatistics, measure
from twinform.compiler.statistics.meshes import MeshCost
from twinform.compiler.statistics.model import ModelStatistics
from twinform.compiler.statistics.reporters import REPORTERS

__all__ = ["REPORTERS", "FileStatistics", "MeshCost", "ModelStatistics", "WorldStatistics", "measure"]
