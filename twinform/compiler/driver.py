"""`convert`, which converts a file for everybody or for certain consumers, and `plan`, which returns its passes."""

from typing import Unpack

from twinform.compiler.conversion import Conversion, convert_once
from twinform.compiler.input.load_options import CheckOptions, Input, LoadOptions, LoadResult, checking_options
from twinform.compiler.request import ConversionRequest
from twinform.ir import Document
from twinform.option import require_options
from twinform.passes import PassInstrumentation, Pipeline
from twinform.request_options import Language, RequestOptions


class ConversionOptions(CheckOptions, RequestOptions, total=False):
    """How a file is read, and what its model becomes."""


def plan(source: Document, *, to: Language, **options: Unpack[RequestOptions]) -> Pipeline:
    """Return every pass that `convert` runs on a document.

    Raises:
        ValueError: SDF has no such version.
    """
    require_options(options, RequestOptions)
    return ConversionRequest.of(to, options).plan(source)


def convert(
    source: Input,
    *,
    to: Language,
    name: str = "",
    instrumentation: PassInstrumentation | None = None,
    **options: Unpack[ConversionOptions],
) -> Conversion:
    """Compile a file, the bytes of one or a document into the target's format; `instrumentation` sees each pass.

    `options` on reading are those of `check`. URDF has no includes: for it, those in the model are always expanded.
    `comments` are those of the source, which go along. `profiles` are those of the consumers of the result, or their
    names with commas between: passes that help them run too, none that changes the physics where `keep_physics` is
    true.

    Raises:
        CompileError: the source, a pass or the result has an error.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
        TypeError: there is no such option.
        ValueError: SDF has no such version.
    """
    require_options(options, ConversionOptions)
    request, load_options = ConversionRequest.of(to, options), checking_options(options)
    return run_conversion(request, source, load_options, name=name, instrumentation=instrumentation)


def run_conversion(
    request: ConversionRequest,
    source: Input | LoadResult,
    load_options: LoadOptions,
    *,
    name: str = "",
    instrumentation: PassInstrumentation | None = None,
) -> Conversion:
    """Convert a source as `convert` does, with the options as a request.

    Raises:
        CompileError: the source, a pass or the result has an error, or a consumer would refuse the result.
    """
    if load_options.profiles:
        from twinform.compiler.fitting import convert_for_consumers  # noqa: PLC0415 - most results are for everybody

        return convert_for_consumers(request, source, load_options, name=name, instrumentation=instrumentation)
    return convert_once(request, source, load_options, name=name, instrumentation=instrumentation)
