"""Work on many models, on any executor, resumable: models in which nothing has changed are not worked on again.

`entries` lists the models, `jobs` is what is done with one, `planning` finds what is known from earlier runs, `task`
does the work on one model wherever it lands, and `recording` keeps the result. `run_batch` puts these together.
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
from twinform.compiler.batch.manifest import BusyError
from twinform.compiler.batch.record import ModelRecord, ModelResult, Outcome, Summary
from twinform.compiler.batch.recording import merge
from twinform.compiler.batch.run_batch import Batch, UnfitWorkerError, batch

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
    "pairs",
    "with_arguments",
]
