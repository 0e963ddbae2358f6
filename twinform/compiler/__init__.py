"""The compiler: front ends, back ends and the driver that runs what lies between."""

from twinform.compiler.checking import check
from twinform.compiler.driver import Conversion, convert, fulfil, plan
from twinform.compiler.dumping import dump, dumps
from twinform.compiler.errors import CompileError
from twinform.compiler.files import write_all_atomically, write_atomically
from twinform.compiler.includes import expand
from twinform.compiler.inspection import LookingError, inspect
from twinform.compiler.loading import Checked, Input, Reading, load, loads, read
from twinform.compiler.orders import DEFAULT_SDF_VERSION, URDF_VERSIONS, Language, Order, UrdfVersion
from twinform.compiler.splitting import Split, split
from twinform.compiler.uris import SearchPath, UriError

__all__ = [
    "DEFAULT_SDF_VERSION",
    "URDF_VERSIONS",
    "Checked",
    "CompileError",
    "Conversion",
    "Input",
    "Language",
    "LookingError",
    "Order",
    "Reading",
    "SearchPath",
    "Split",
    "UrdfVersion",
    "UriError",
    "check",
    "convert",
    "dump",
    "dumps",
    "expand",
    "fulfil",
    "inspect",
    "load",
    "loads",
    "plan",
    "read",
    "split",
    "write_all_atomically",
    "write_atomically",
]
