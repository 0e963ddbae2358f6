"""The robot model compiler between URDF, SDF and MJCF: strict, lossless, all ways.

    import twinform

    document = twinform.load("robot.urdf")
    result = twinform.convert("robot.urdf", to="sdf", sdf_version="1.11", passes="check-inertia")
    result.text, result.document, result.diagnostics, result.ledger

Names are imported when they are first used, so that `import twinform` costs nothing.
"""

from twinform.lazy import lazy_attributes
from twinform.notebooks import DRAWN_BY

TYPE_CHECKING = False  # `typing` takes longer than all that is here
if TYPE_CHECKING:
    from twinform.compiler import CompileError, Conversion, check, convert, dump, dumps, load, loads, write_atomically
    from twinform.compiler.compare import Comparison, Difference, diff
    from twinform.compiler.descriptions import load_description
    from twinform.compiler.normal_form import Discrepancy, NormalForm, normal_form
    from twinform.compiler.scene import forward_kinematics
    from twinform.diagnostics import Diagnostic, Ledger
    from twinform.ir import Document
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.compiler": "CompileError Conversion check convert dump dumps load loads write_atomically",
            "twinform.compiler.compare": "Comparison Difference diff",
            "twinform.compiler.descriptions": "load_description",
            "twinform.compiler.scene": "forward_kinematics",
            "twinform.compiler.normal_form": "Discrepancy NormalForm normal_form",
            "twinform.diagnostics": "Diagnostic Ledger",
            "twinform.ir": "Document",
        },
    )

DRAWN_BY.update(
    Document=("twinform.report.notebook", "document_html"), Conversion=("twinform.report.notebook", "conversion_html")
)
__version__ = "0.1.0"
__all__ = [
    "Comparison",
    "CompileError",
    "Conversion",
    "Diagnostic",
    "Difference",
    "Discrepancy",
    "Document",
    "Ledger",
    "NormalForm",
    "check",
    "convert",
    "diff",
    "dump",
    "dumps",
    "forward_kinematics",
    "load",
    "load_description",
    "loads",
    "normal_form",
    "write_atomically",
]


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
