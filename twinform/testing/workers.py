"""Processes that may die, for tests that ask programs which do: those of the compiler."""

from twinform.compiler.workers import Failure, run

__all__ = ["Failure", "run"]
