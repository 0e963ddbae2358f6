"""Batch conversion of a folder of models: each in its own process, and resumable."""

from twinform.compiler.batch.driver import Batch, batch
from twinform.compiler.batch.files import PATTERNS, FolderError
from twinform.compiler.batch.record import Outcome, Record, report, summary

__all__ = ["PATTERNS", "Batch", "FolderError", "Outcome", "Record", "batch", "report", "summary"]
