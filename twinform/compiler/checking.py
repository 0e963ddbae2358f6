"""`check`: reads a file, reports everything that is wrong with it, and runs read-only passes."""

from typing import TYPE_CHECKING, Unpack

from twinform.compiler.input.load_options import CheckOptions, Input, LoadResult, checking_options
from twinform.compiler.input.loading import read
from twinform.compiler.inspection import as_refused, inspect
from twinform.option import require_options

if TYPE_CHECKING:
    from twinform.passes import Pipeline


def check(
    source: Input, *, name: str = "", passes: "str | Pipeline | None" = None, **options: Unpack[CheckOptions]
) -> LoadResult:
    """Read a file, the bytes of one or a document, and say everything that is wrong with it.

    `paths` are folders in which URIs are looked up. A file whose name ends in `.xacro` is expanded with the
    `arguments`, which evaluates expressions and reads files that it names; where `xacro` is true others are as well,
    and where it is false all are refused. The files that includes name are read only where `expand_includes` asks for
    it. `passes` are run on a model without errors, for what they find. Files of more than `max_size` bytes or
    `max_tags` tags are refused. Findings of the rules in `allow` are left out, as are those that comments in the files
    allow; they are `allowed` in the result. `profiles` are those of the consumers of the model, or their names
    with commas between. Xacro files may read the environment variables that `env` names besides those of ROS and
    Gazebo.

    Raises:
        ReadOnlyPassError: a pass would change the model.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
        TypeError: there is no such option.
    """
    require_options(options, CheckOptions)
    load_options = checking_options(options)
    if isinstance(passes, str):
        from twinform.passes import parse_pipeline  # noqa: PLC0415 - most checks have no passes

        passes = parse_pipeline(passes)
    loaded = read(source, load_options, name=name)
    if options.get("expand_includes"):
        from twinform.compiler.expand_includes import expand  # noqa: PLC0415 - most checks read one file

        loaded = expand(loaded, load_options)
    return as_refused(inspect(loaded, load_options, passes))
