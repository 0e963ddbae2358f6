"""Xacro files that a document leads to and that are no models, such as an SRDF: they are expanded for passes."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.resolve_uris import LocalAssets
from twinform.diagnostics import DiagnosticSink, rules
from twinform.passes import AssetError


def assets_of(path: str | Path, load_options: LoadOptions) -> LocalAssets:
    """Return the files that the document of a file names, for passes that may want the text of xacro files."""
    return LocalAssets(load_options.search, Path(path), _expander(load_options))


def _expander(load_options: LoadOptions) -> Callable[[Path], bytes]:
    # arguments of the command line are for the file that it names
    return partial(_expanded, replace(load_options, arguments={}))


def _expanded(load_options: LoadOptions, path: Path) -> bytes:
    """Return the text of a xacro file.

    Raises:
        AssetError: it cannot be expanded, or must not be.
    """
    from twinform.compiler.input.expand_xacro import expand  # noqa: PLC0415 - few files need it

    if load_options.xacro is False:
        raise AssetError(rules.XACRO_REFUSED, f"{path.name!r} is a xacro file, and xacro is refused here")
    sink = DiagnosticSink(str(path))
    try:
        expansion = expand(path, load_options, sink)
    except UnreadableError:
        first = next(each for each in sink.diagnostics if each.is_error)
        raise AssetError(first.rule, first.message, first.help) from None
    load_options.search.seen.update(map(Path, {place.file for place in expansion.origins.places}))
    return expansion.text
