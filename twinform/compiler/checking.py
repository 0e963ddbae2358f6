"""`check`: read a file, say everything that is wrong with it, and run passes that only look."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from twinform.compiler.includes import expand
from twinform.compiler.inputs import Checked, Input, Reading
from twinform.compiler.inspection import inspect
from twinform.compiler.loading import read
from twinform.compiler.uris import SearchPath
from twinform.passes import Pipeline, parse_pipeline
from twinform.schemas import Engine


def check(
    source: Input,
    *,
    name: str = "",
    strict: bool = False,
    engine: Engine = "libxml2",
    paths: Iterable[str | Path] = (),
    arguments: Mapping[str, str] | None = None,
    xacro: bool | None = None,
    expand_includes: bool = False,
    passes: str | Pipeline | None = None,
) -> Checked:
    """Read a file, the bytes of one or a document, and say everything that is wrong with it.

    `paths` are folders in which URIs are looked up. A file whose name ends in `.xacro` is expanded with the
    `arguments`, which evaluates expressions and reads files that it names; where `xacro` is true others are as well,
    and where it is false all are refused. The files that includes name are read only where `expand_includes` asks for
    it. `passes` are run on a model without errors, for what they find.

    Raises:
        LookingError: a pass would change the model.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
    """
    how = Reading(strict, engine, SearchPath.of(paths), arguments or {}, xacro)
    pipeline = parse_pipeline(passes) if isinstance(passes, str) else passes
    checked = read(source, how, name=name)
    return inspect(expand(checked, how) if expand_includes else checked, how, pipeline)
