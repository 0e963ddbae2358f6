"""Work on many models: on any executor, resumable, and on none of which anything has changed.

`entries` lists the models, `jobs` is what is done with one, `planning` finds what is known already, `task` is the work
on one, wherever it is done, and `recording` keeps the result. `driver` puts these together.
"""

from twinform.compiler.batch.entries import (
    PATTERNS,
    FolderError,
    ModelEntry,
    Shard,
    of_folder,
    of_names,
    pairs,
    with_arguments,
)
from twinform.compiler.batch.jobs import Check, Convert, Diff, Stats
from twinform.compiler.batch.lock import BusyError
from twinform.compiler.batch.merging import merge
from twinform.compiler.batch.record import ModelRecord, Outcome, Summary
from twinform.compiler.batch.recording import ModelResult
from twinform.compiler.batch.report import open_report, report_line
from twinform.compiler.batch.run_batch import Batch, batch
from twinform.compiler.batch.worksite import UnfitWorkerError

__all__ = [
    "PATTERNS",
    "Batch",
    "BusyError",
    "Check",
    "Convert",
    "Diff",
    "FolderError",
    "ModelEntry",
    "ModelRecord",
    "ModelResult",
    "Outcome",
    "Shard",
    "Stats",
    "Summary",
    "UnfitWorkerError",
    "batch",
    "merge",
    "of_folder",
    "of_names",
    "open_report",
    "pairs",
    "report_line",
    "with_arguments",
]
