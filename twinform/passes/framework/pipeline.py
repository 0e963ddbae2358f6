"""Pipelines: passes in sequence. Their text is in `text.py`, their table in `tables.py`."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.asset_access import Assets
from twinform.passes.framework.assets import AssetPass
from twinform.passes.framework.instrumentation import PassInstrumentation
from twinform.passes.framework.other_documents import DocumentPass, DocumentReader, Refusal
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_errors import BrokenPassError, FailedPassError

Verifier = Callable[[Document, DiagnosticSink], None]
"""Reports what is wrong with a document; it is a function of `twinform.ir.verify`."""


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Passes that run one after the other."""

    passes: tuple[Pass, ...] = ()

    def run(
        self,
        document: Document,
        sink: DiagnosticSink,
        instrumentation: PassInstrumentation | None = None,
        verify: Verifier | None = None,
    ) -> Document:
        """The document after all passes; a document that a pass changed is verified.

        Raises:
            FailedPassError: a pass raised an exception.
            BrokenPassError: a pass made IR that the verifier refuses.
        """
        instrumentation = instrumentation or _NOBODY
        for step in self.passes:
            document = _run(step, document, sink, instrumentation, verify)
        return document

    def with_files(self, assets: Assets, reader: DocumentReader | None = None) -> "Pipeline":
        """Return the pipeline with each pass bound to the files and the reader that it needs."""
        return Pipeline(tuple(_lend(each, assets, reader) for each in self.passes))

    def with_refusal(self, refusal: Refusal) -> "Pipeline":
        """Return the pipeline with passes that do not read the documents which `refusal` refuses."""
        return Pipeline(tuple(each.with_refusal(refusal) if isinstance(each, DocumentPass) else each for each in self))

    def __iter__(self) -> Iterator[Pass]:
        return iter(self.passes)

    def __len__(self) -> int:
        return len(self.passes)

    def __str__(self) -> str:
        """The canonical text: defaults are left out, and parsing it gives the same pipeline back.

        Raises:
            TypeError: an option has a value that has no form in the text.
        """
        from twinform.passes.framework.pass_options import chosen  # noqa: PLC0415 - few pipelines are printed
        from twinform.passes.framework.syntax import print_call  # noqa: PLC0415 - see above

        return ",".join(print_call(each.name, dict(chosen(each))) for each in self)


_NOBODY = PassInstrumentation()


def _lend(step: Pass, assets: Assets, reader: DocumentReader | None) -> Pass:
    if isinstance(step, AssetPass):
        return step.with_assets(assets)
    return step.with_reader(reader) if reader and isinstance(step, DocumentPass) else step


def _run(
    step: Pass, old: Document, sink: DiagnosticSink, instrumentation: PassInstrumentation, verify: Verifier | None
) -> Document:
    instrumentation.before(step, old, sink)
    try:
        new = step.run(old, sink)
    except Exception as cause:
        # The error carries the pass and the document that it was given, so the file that reproduces
        # a fault needs no hook and no second run: it is there wherever a pass fails, be it in an
        # include, in legalisation or on the way back.
        error = FailedPassError(step, old, cause)
        instrumentation.failed(step, error, sink)
        raise error from cause
    instrumentation.after(step, old, new, sink)
    problems = _problems(new, verify) if verify and new is not old else ()
    if problems:
        error = BrokenPassError(step, old, problems)
        instrumentation.failed(step, error, sink)
        raise error
    return new


def _problems(document: Document, verify: Verifier) -> tuple[Diagnostic, ...]:
    """Warnings are left out: the document had them before, or the pass has reported them itself."""
    found = DiagnosticSink()
    verify(document, found)
    return tuple(each for each in found.diagnostics if each.is_error) if found.has_errors else ()
