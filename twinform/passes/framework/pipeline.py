"""Pipelines, which run passes in sequence, and the interface of hooks around each pass."""

from collections.abc import Callable, Iterable, Iterator

from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.assets import Assets
from twinform.passes.framework.pass_base import AssetPass, DocumentPass, DocumentReader, Pass, Refusal
from twinform.passes.framework.pass_errors import BrokenPassError, FailedPassError, PassError


class PassInstrumentation:
    """The interface of a hook, which is called before and after each pass and where one fails. It does nothing itself.

    A hook only observes: documents are frozen, and the diagnostics are there to be read.
    """

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """The pass is about to run on the document."""

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """The pass has run; `new is old` where it changed nothing. The new document is not verified yet."""

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """The pass raised an exception, or made an invalid document; then `after` was called before."""


class CombinedInstrumentation(PassInstrumentation):
    """Several hooks as one, nested like brackets: the last one, such as a clock, is nearest to the pass."""

    def __init__(self, hooks: Iterable[PassInstrumentation]) -> None:
        self._hooks = tuple(hooks)

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """Call all hooks, the first one first."""
        for each in self._hooks:
            each.before(step, document, sink)

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Call all hooks, the last one first."""
        for each in reversed(self._hooks):
            each.after(step, old, new, sink)

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """Call all hooks, the last one first."""
        for each in reversed(self._hooks):
            each.failed(step, error, sink)


Verifier = Callable[[Document, DiagnosticSink], None]
"""Reports what is wrong with a document, as a function of `twinform.ir.verify` does."""


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
        """The canonical text, without defaults; parsing it gives the same pipeline.

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
        # The error carries the pass and its input, so that a reproducer can be written wherever a
        # pass fails (in an include, in legalisation, in a put-back), without a hook or a second run.
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
    """The errors in a document. Warnings were there before, or the pass has reported them itself."""
    found = DiagnosticSink()
    verify(document, found)
    return tuple(each for each in found.diagnostics if each.is_error) if found.has_errors else ()
