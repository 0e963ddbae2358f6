"""The comparison of robots: do two files, of either format, describe the same one?"""

from twinform.compiler.compare.comparison import Comparison, Difference, Severity, Side
from twinform.compiler.compare.driver import TOLERANCE, compare_files, diff

__all__ = ["TOLERANCE", "Comparison", "Difference", "Severity", "Side", "compare_files", "diff"]
