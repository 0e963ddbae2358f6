"""The comparison of robots: do two files, of either format, describe the same one?"""

from twinform.compiler.compare.comparison import Comparison, Difference, Said, Severity
from twinform.compiler.compare.driver import TOLERANCE, compare_files, diff

__all__ = ["TOLERANCE", "Comparison", "Difference", "Said", "Severity", "compare_files", "diff"]
