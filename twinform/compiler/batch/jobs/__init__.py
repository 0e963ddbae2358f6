"""What a batch does with each model: one file for each."""

from twinform.compiler.batch.jobs.check_job import Check
from twinform.compiler.batch.jobs.convert_job import Convert
from twinform.compiler.batch.jobs.diff_job import Diff
from twinform.compiler.batch.jobs.stats_job import Stats

__all__ = ["Check", "Convert", "Diff", "Stats"]
