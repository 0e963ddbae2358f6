"""Files before profiles: reads a file as `check` does, and says what each consumer makes of it."""

from collections.abc import Iterable
from pathlib import Path

from twinform.compiler.input.loading import read
from twinform.compiler.input.options import Input, LoadOptions, LoadResult
from twinform.compiler.inspection import inspect
from twinform.compiler.search.uris import LocalAssets
from twinform.ir import Format
from twinform.profiles import Assessment, Profile, Subject, assess

_FORMATS = {"robot": Format.URDF, "sdf": Format.SDF, "gazebo": Format.SDF}
"""The formats by the roots of their files."""


def assess_file(
    source: Input, profiles: Iterable[Profile], load_options: LoadOptions, *, name: str = ""
) -> tuple[Assessment, ...]:
    """What each consumer makes of a file, the bytes of one or a document; it is read once."""
    return assess(subject_of(inspect(read(source, load_options, name=name), load_options), load_options), profiles)


def subject_of(loaded: LoadResult, load_options: LoadOptions) -> Subject:
    """A file that was read and inspected, as profiles see it. What comments in it allow is there for consumers too."""
    found = (*loaded.diagnostics, *loaded.allowed)
    assets = LocalAssets(load_options.search, Path(loaded.path))
    return Subject(loaded.path, _format(loaded), loaded.document, loaded.tree, loaded.content, found, assets)


def _format(loaded: LoadResult) -> Format | None:
    if loaded.document is not None:
        return loaded.document.format
    root = str(loaded.tree.tag) if loaded.tree is not None else ""
    return _FORMATS.get(root)
