"""Access to other documents for passes, by an interface that the driver implements."""

from abc import abstractmethod
from collections.abc import Callable
from typing import Protocol, Self

from pydantic import PrivateAttr

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import UNREAD_DOCUMENT
from twinform.ir import Document
from twinform.passes.framework.pass_base import Pass


class DocumentReader(Protocol):
    """Reads another model file for a pass."""

    def __call__(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        """The document of a file, verified, in the format and version of the one `around`; None after an error.

        `path` is a path or a `package://` or `model://` URI. Relative paths in the file lead to the same files from
        where the document around was read.
        """
        ...


Refusal = Callable[[str], str | None]
"""The reason why a pass must not have the file of a path; None where it may."""


# A registry of services would hide what a pass needs; files that the command line reads beforehand
# would make options of one pass a matter of every caller.
class DocumentPass(Pass):
    """A pass whose purpose needs other documents. Whoever runs it lends it a reader, by `with_reader`."""

    _reader: DocumentReader | None = PrivateAttr(default=None)
    _refusal: Refusal | None = PrivateAttr(default=None)

    def with_reader(self, reader: DocumentReader) -> Self:
        """Return a copy of the pass that reads other documents through this reader."""
        bound = self.model_copy()
        bound._reader = reader  # noqa: SLF001 - its own
        return bound

    def with_refusal(self, refusal: Refusal) -> Self:
        """Return a copy of the pass that does not read the documents which `refusal` refuses."""
        bound = self.model_copy()
        bound._refusal = refusal  # noqa: SLF001 - its own
        return bound

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Without a reader there is nothing that it can do."""
        if self._reader is not None:
            return self.run_with(document, sink, self._read)
        sink.report(UNREAD_DOCUMENT, f"{self.name} needs other files, and this run cannot read any", document.location)
        return document

    def _read(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        problem = self._refusal(path) if self._refusal else None
        if problem is None:
            return self._reader(path, around, sink) if self._reader else None
        sink.report(UNREAD_DOCUMENT, problem, around.location, found=path)
        return None

    @abstractmethod
    def run_with(self, document: Document, sink: DiagnosticSink, read: DocumentReader) -> Document:
        """The document after the pass; the one that came in where nothing changes."""
