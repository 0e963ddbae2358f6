"""The compiler: front ends, back ends and the driver that runs what lies between."""

from twinform.compiler.driver import DEFAULT_SDF_VERSION, Conversion, UrdfVersion, convert, plan
from twinform.compiler.errors import CompileError
from twinform.compiler.files import write_atomically
from twinform.compiler.loading import Checked, check, load, loads

__all__ = [
    "DEFAULT_SDF_VERSION",
    "Checked",
    "CompileError",
    "Conversion",
    "UrdfVersion",
    "check",
    "convert",
    "load",
    "loads",
    "plan",
    "write_atomically",
]
