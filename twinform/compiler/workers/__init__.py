"""Runs jobs in processes, or on any executor, each of which may die without harm to the others."""

from twinform.compiler.workers.processes import process_runner, run
from twinform.compiler.workers.running import Failure, NotStartedError, Runner, UnavailableError, run_on

__all__ = ["Failure", "NotStartedError", "Runner", "UnavailableError", "process_runner", "run", "run_on"]
