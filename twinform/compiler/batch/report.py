"""The report of a batch: a line of JSON for each model, written as it goes."""

import json
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from twinform.compiler.batch.recording import ModelResult
from twinform.storage.writing import refuse_way_out


def report_line(result: ModelResult) -> str:
    """What a program may want to know of a model."""
    record = result.record
    row = {
        "source": record.source,
        "outcome": str(record.outcome),
        "known": result.known,
        "results": [each.path for each in record.results],
        "kept": [each.path for each in record.kept.results] if record.kept else [],
        "message": record.message,
        "diagnostics": record.diagnostics,
        "ledger": record.ledger,
        **record.details,
    }
    return json.dumps(row) + "\n"


@contextmanager
def open_report(path: Path) -> Generator[TextIO]:
    """A file that has every line as soon as it is written; folders that are missing are made.

    Raises:
        OSError: it cannot be written.
    """
    refuse_way_out(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="ascii", newline="\n", buffering=1) as file:
        yield file
