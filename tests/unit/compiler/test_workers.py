"""Processes that may die. That a job harms no other is in tests/unit/test_benchmarks.py."""

import os
import signal
import time

from twinform.compiler.workers import Failure, run


def _nothing(_: int) -> None:
    return None


def _linger(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def _die(_: int) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_nothing_is_a_result_like_any_other() -> None:
    assert dict(run(_nothing, range(3), processes=2)) == {0: None, 1: None, 2: None}
    assert list(run(_nothing, [])) == []


def test_a_job_that_is_late_is_told_from_one_that_died() -> None:
    late = dict(run(_linger, [0.0, 600.0], seconds=2, processes=1))
    assert late == {0.0: 0.0, 600.0: Failure("did not come to an end", late=True)}
    ((_, died),) = run(_die, [1])
    assert died == Failure("the process died (exit code -9)")
