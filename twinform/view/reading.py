"""Reads what is to be shown: a file with its findings, and what a conversion to the other format makes of its parts."""

from collections.abc import Mapping

from twinform.compiler.driver import convert
from twinform.compiler.errors import CompileError
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, read
from twinform.compiler.inspection import inspect
from twinform.compiler.scene import build_scene
from twinform.diagnostics.ledger import Entry
from twinform.ir import Document, Format
from twinform.passes import PassError
from twinform.view.subject import Subject

_OTHER: Mapping[Format, Format] = {Format.URDF: Format.SDF, Format.SDF: Format.URDF}


def read_subject(source: Input, load_options: LoadOptions, *, name: str = "") -> tuple[Subject | None, LoadResult]:
    """What is to be shown of a file or document; None where so much is wrong with it that there is nothing to show."""
    loaded = inspect(expand(read(source, load_options, name=name), load_options), load_options)
    document = loaded.document
    if document is None:
        return None, loaded
    entries = _entries(document) if loaded.accepted else ()
    scene = build_scene(document)
    return Subject(document, scene, loaded.path, load_options.search, loaded.diagnostics, entries), loaded


def _entries(document: Document) -> tuple[Entry, ...]:
    """The ledger of a conversion to the other format; nothing where it ends with an error."""
    try:
        return convert(document, to=_OTHER[document.format].value).ledger.entries
    except (CompileError, PassError):
        return ()
