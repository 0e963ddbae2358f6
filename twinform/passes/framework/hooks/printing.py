"""Printing what a pass changed: one line for each value, with its path in the IR."""

import json
from collections.abc import Callable, Iterator

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.ir.changes import ChangeKind, NodeChange, changes, count_changes
from twinform.ir.sourced import Sourced
from twinform.passes.framework.instrumentation import PassInstrumentation
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pipeline import Pipeline


# Values of the IR and no diff of the text: between the passes of legalisation a document is half in
# one format and half in the other, and there is no such text. Values also tell what is absent from
# what has its default.
class PrintChanges(PassInstrumentation):
    """Writes what each pass changed; nothing for a pass that changed nothing."""

    def __init__(self, write: Callable[[str], None]) -> None:
        """`write` is given the text of one pass, several lines without the last line end."""
        self._write = write

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Write the changes, if there are any."""
        del sink
        lines = list(map(line_of, changes(old, new)))
        if lines:
            self._write("\n".join([f"{Pipeline((step,))}: {_counted(old, new)}", *lines]))


def _counted(old: Document, new: Document) -> str:
    words = zip(("changed", "added", "removed"), count_changes(old, new), strict=True)
    return ", ".join(f"{count} node{'' if count == 1 else 's'} {word}" for word, count in words if count)


def line_of(change: NodeChange) -> str:
    """One change as `sign path: old -> new`."""
    start = f"  {change.how} {change.path}"
    match change.how:
        case ChangeKind.REORDERED:
            return f"{start}: now in the order {' '.join(_items(change.new))}"
        case ChangeKind.CHANGED:
            return f"{start}: {_show_value(change.old)} -> {_show_value(change.new)}"
        case _ if change.is_node:
            return start
        case _:
            return f"{start}: {_show_value(change.old if change.how is ChangeKind.REMOVED else change.new)}"


def _items(labels: object) -> Iterator[str]:
    if isinstance(labels, list):
        yield from map(str, labels)  # pyright: ignore[reportUnknownArgumentType] - labels are text


def _show_value(value: object) -> str:
    """A value as the JSON of a document has it."""
    if value is None:
        return "not set"
    if isinstance(value, Sourced):
        return value.model_dump_json(exclude_defaults=True)
    return json.dumps(value, default=str, ensure_ascii=False)
