"""A file before profiles: reads it as `check` does, and says what each consumer makes of it."""

from collections.abc import Iterable

from twinform.compiler.input.load_options import Input, LoadOptions
from twinform.compiler.input.loading import read
from twinform.compiler.inspection import inspect
from twinform.compiler.inspection.inspect_for_consumers import subject_of
from twinform.profiles import Assessment, Profile, assess


def assess_file(
    source: Input, profiles: Iterable[Profile], load_options: LoadOptions, *, name: str = ""
) -> tuple[Assessment, ...]:
    """What each consumer makes of a file, the bytes of one or a document; it is read once."""
    loaded = inspect(read(source, load_options, name=name), load_options)
    return assess(subject_of(loaded, load_options), profiles)
