"""What a batch does with each model: one file for each."""

from twinform.compiler.batch.jobs.check import Check
from twinform.compiler.batch.jobs.convert import Convert
from twinform.compiler.batch.jobs.diff import Diff
from twinform.compiler.batch.jobs.stats import Stats

__all__ = ["Check", "Convert", "Diff", "Stats"]
