"""The comparison of robots: do two files, of either format, describe the same one?"""

from twinform.compiler.compare.compare_files import compare_files, diff
from twinform.compiler.compare.comparison import (
    TOLERANCE,
    USUAL,
    Comparison,
    ComparisonOptions,
    Difference,
    DifferenceSeverity,
    Side,
)

__all__ = [
    "TOLERANCE",
    "USUAL",
    "Comparison",
    "ComparisonOptions",
    "Difference",
    "DifferenceSeverity",
    "Side",
    "compare_files",
    "diff",
]
