"""The compiler: front ends, back ends and the driver that runs what lies between."""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.compiler.conversion import Conversion
    from twinform.compiler.conversion_error import CompileError, ReadOnlyPassError
    from twinform.compiler.driver import convert, plan, run_conversion
    from twinform.compiler.dumping import dump, dumps
    from twinform.compiler.expand_includes import expand
    from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, load, loads, read
    from twinform.compiler.inspection import as_refused, check, inspect
    from twinform.compiler.request import ConversionRequest
    from twinform.compiler.resolve_uris import SearchPath, UriError
    from twinform.compiler.split_world import SplitWorld, split
    from twinform.request_options import URDF_VERSIONS, Language, UrdfVersion
    from twinform.schemas import DEFAULT_SDF_VERSION
    from twinform.storage.writing import write_all_atomically, write_atomically
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.compiler.inspection": "check as_refused inspect",
            "twinform.compiler.conversion": "Conversion",
            "twinform.compiler.driver": "convert plan run_conversion",
            "twinform.compiler.dumping": "dump dumps",
            "twinform.compiler.conversion_error": "CompileError ReadOnlyPassError",
            "twinform.compiler.expand_includes": "expand",
            "twinform.compiler.input.loading": "Input LoadOptions LoadResult load loads read",
            "twinform.schemas": "DEFAULT_SDF_VERSION",
            "twinform.storage.writing": "write_all_atomically write_atomically",
            "twinform.compiler.request": "ConversionRequest",
            "twinform.request_options": "URDF_VERSIONS Language UrdfVersion",
            "twinform.compiler.resolve_uris": "SearchPath UriError",
            "twinform.compiler.split_world": "SplitWorld split",
        },
    )

__all__ = [
    "DEFAULT_SDF_VERSION",
    "URDF_VERSIONS",
    "CompileError",
    "Conversion",
    "ConversionRequest",
    "Input",
    "Language",
    "LoadOptions",
    "LoadResult",
    "ReadOnlyPassError",
    "SearchPath",
    "SplitWorld",
    "UrdfVersion",
    "UriError",
    "as_refused",
    "check",
    "convert",
    "dump",
    "dumps",
    "expand",
    "inspect",
    "load",
    "loads",
    "plan",
    "read",
    "run_conversion",
    "split",
    "write_all_atomically",
    "write_atomically",
]
