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
    """Compile a file, the bytes of one or a document into the target's format.

    URDF has no includes: for it, those in the model are always expanded. For the consumers of the result, passes that
    help them run too.

    Example:
        >>> result = twinform.convert("examples/rover.urdf", to="sdf", sdf_version="1.9", passes="check-inertia")
        >>> result.document.version, result.ledger.expressed, [each.rule.name for each in result.diagnostics]
        ('1.9', 478, ['gazebo-material'])
        >>> twinform.write_atomically("out/rover.sdf", result.text)

    Args:
        source: The path of a file, the bytes of one, or a document.
        to: The format of the result.
        name: What stands for the source in diagnostics, where it has no path.
        instrumentation: What is called before and after each pass.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.
        expand_includes: Read the files that includes name, and put them in their place.
        allow: The rules whose findings are left out.
        profiles: The consumers of the model, or their names with commas between.
        sdf_version: The version of SDF to write.
        urdf_version: The version of URDF to write.
        passes: Passes to run, such as 'check-inertia', or @NAME for one that the configuration names.
        carriers: Whether to keep what the target lacks in elements of tf:.
        shape_error: How far a mesh that stands for a shape which the target lacks may be from it, in m; else 1 % of its
            largest radius.
        mesh_prefix: What the URIs of such meshes begin with, such as package://arm; else they are relative paths.
        keep_paths: Leave relative paths as they are in the source, for a result that will lie beside it; else they lead
            from the folder of the result.
        default_classes: Whether MJCF has classes of defaults for what many of its elements say alike.
        side_files: Whether meshes may be made that have to lie beside the result, such as that of an ellipsoid.
        comments: Whether comments of the source go along.
        model: The model that is meant, where a file has several.
        keep_physics: Refuse passes for consumers that change masses, inertias, joints or limits.

    Raises:
        CompileError: the source, a pass or the result has an error.
        FileNotFoundError: there is no such file; this is a CompileError too.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
        TypeError: there is no such option.
        ValueError: there is no such format, SDF has no such version, or an option has no such value.
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
