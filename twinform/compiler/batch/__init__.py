"""A folder of models into another format: every model by itself, and nothing that was done is done again."""

from twinform.compiler.batch.driver import Batch, batch
from twinform.compiler.batch.files import PATTERNS, FolderError
from twinform.compiler.batch.record import Outcome, Record, report, summary

__all__ = ["PATTERNS", "Batch", "FolderError", "Outcome", "Record", "batch", "report", "summary"]
