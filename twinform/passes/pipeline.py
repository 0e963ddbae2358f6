"""Passes in a row. Their text is in `text.py`, their table in `tables.py`."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from twinform.diagnostics import Diagnostic, Notes
from twinform.ir import Document
from twinform.passes.assets import AssetPass, Assets
from twinform.passes.base import Pass
from twinform.passes.errors import BrokenPassError, FailedPassError
from twinform.passes.options import chosen
from twinform.passes.other_documents import DocumentPass, DocumentReader
from twinform.passes.syntax import print_call
from twinform.passes.watch import Watch

Verifier = Callable[[Document, Notes], None]
"""Notes what is wrong with a document; `twinform.ir.verify` has it."""


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Passes that run one after the other."""

    passes: tuple[Pass, ...] = ()

    def run(
        self,
        document: Document,
        notes: Notes,
        watch: Watch | None = None,
        verify: Verifier | None = None,
    ) -> Document:
        """The document after all passes; a document that a pass changed is verified.

        Raises:
            FailedPassError: a pass raised an exception.
            BrokenPassError: a pass made IR that the verifier refuses.
        """
        watch = watch or _NOBODY
        for step in self.passes:
            document = _run(step, document, notes, watch, verify)
        return document

    def with_files(self, assets: Assets, reader: DocumentReader | None = None) -> "Pipeline":
        """The same passes; those that open files know where they are, those that need other models who reads them."""
        return Pipeline(tuple(_lend(each, assets, reader) for each in self.passes))

    def __iter__(self) -> Iterator[Pass]:
        return iter(self.passes)

    def __len__(self) -> int:
        return len(self.passes)

    def __str__(self) -> str:
        """The canonical text: defaults are left out, and parsing it gives the same pipeline back.

        Raises:
            TypeError: an option has a value that the text cannot say.
        """
        return ",".join(print_call(each.name, dict(chosen(each))) for each in self)


_NOBODY = Watch()


def _lend(step: Pass, assets: Assets, reader: DocumentReader | None) -> Pass:
    if isinstance(step, AssetPass):
        return step.with_assets(assets)
    return step.with_reader(reader) if reader and isinstance(step, DocumentPass) else step


def _run(step: Pass, old: Document, notes: Notes, watch: Watch, verify: Verifier | None) -> Document:
    watch.before(step, old, notes)
    try:
        new = step.run(old, notes)
    except Exception as cause:
        error = FailedPassError(step, old, cause)
        watch.failed(step, error, notes)
        raise error from cause
    watch.after(step, old, new, notes)
    problems = _problems(new, verify) if verify and new is not old else ()
    if problems:
        error = BrokenPassError(step, old, problems)
        watch.failed(step, error, notes)
        raise error
    return new


def _problems(document: Document, verify: Verifier) -> tuple[Diagnostic, ...]:
    """Warnings are left out: the document had them before, or the pass has said so itself."""
    found = Notes()
    verify(document, found)
    return tuple(each for each in found.diagnostics if each.is_error) if found.has_errors else ()
