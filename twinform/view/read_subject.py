"""Reads what is to be shown: a file with its findings, and what a conversion to the other format makes of its parts."""

from collections.abc import Iterator, Mapping

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import convert
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, read
from twinform.compiler.inspection import inspect
from twinform.compiler.scene import build_scene
from twinform.diagnostics.ledger import LedgerEntry
from twinform.ir import Document, Format, Model
from twinform.passes import PassError
from twinform.passes.analyses.candidates import candidates
from twinform.view.subject import ViewSubject

_OTHER: Mapping[Format, Format] = {Format.URDF: Format.SDF, Format.SDF: Format.URDF}


def read_subject(source: Input, load_options: LoadOptions, *, name: str = "") -> tuple[ViewSubject | None, LoadResult]:
    """What is to be shown of a file or document; None where so much is wrong with it that there is nothing to show."""
    loaded = inspect(expand(read(source, load_options, name=name), load_options), load_options)
    document = loaded.document
    if document is None:
        return None, loaded
    scene = build_scene(document)
    entries, unconverted = _ledger(document) if loaded.accepted else ((), ("it has errors",))
    subject = ViewSubject(
        document, scene, loaded.path, load_options.search, loaded.diagnostics, entries, unconverted
    )  # fmt: skip
    return subject, loaded


def _ledger(document: Document) -> tuple[tuple[LedgerEntry, ...], tuple[str, ...]]:
    """What conversions to the other format make of each model alone, and why there is none of some."""
    entries: list[LedgerEntry] = []
    reasons: list[str] = []
    # With the world around it, each conversion would list all other models as dropped: 28 s and
    # 41,000 entries for 200 models instead of 0.4 s.
    for alone in _each_alone(document):
        try:
            entries += convert(alone, to=_OTHER[document.format].value).ledger.entries
        except (CompileError, PassError) as error:
            reasons.append(str(error).partition("\n")[0])
    return tuple(entries), tuple(reasons)


def _each_alone(document: Document) -> Iterator[Document]:
    """A document for each model, since URDF holds one robot; where it is in a world does not matter to its parts."""
    found = [each.model for each in candidates(document) if isinstance(each.model, Model)]
    if len(found) < 2 and not document.worlds:
        yield document
        return
    for model in found:
        alone = model.copy(pose=None)
        yield document.copy(worlds=(), includes=(), models=(alone,))
