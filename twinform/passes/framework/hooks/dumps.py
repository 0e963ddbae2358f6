"""IR dumps after passes, as JSON."""

from collections.abc import Callable, Collection

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.instrumentation import PassInstrumentation
from twinform.passes.framework.pass_base import Pass


class Dumps(PassInstrumentation):
    """Writes the document after each of some passes, also where it is broken; `seen` are all passes that ran."""

    def __init__(self, names: Collection[str], write: Callable[[str, str], None]) -> None:
        """`write` is given the name of a pass and the JSON of the document that it made."""
        self._names, self._write = names, write
        self.seen: list[str] = []

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Write the document if it was asked for."""
        del old, sink
        self.seen.append(step.name)
        if step.name in self._names:
            self._write(step.name, new.model_dump_json(indent=2, exclude_defaults=True))
