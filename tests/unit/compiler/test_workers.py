"""Processes that may die."""

import os
import signal
import time

import pytest

from twinform.compiler.workers import Failure, run


def _nothing(_: int) -> None:
    return None


def _linger(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def _die(_: int) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def _square_or_fail(number: int) -> int:
    if number == 2:
        os._exit(7)
    if number == 5:
        time.sleep(60)
    return number * number


def _divide(number: int) -> float:
    return 1 / number


def test_nothing_is_a_result_like_any_other() -> None:
    assert dict(run(_nothing, range(3), processes=2)) == {0: None, 1: None, 2: None}
    assert list(run(_nothing, [])) == []


def test_a_job_that_is_late_is_told_from_one_that_died() -> None:
    late = dict(run(_linger, [0.0, 600.0], seconds=2, processes=1))
    assert late == {0.0: 0.0, 600.0: Failure("did not come to an end", late=True)}
    ((_, died),) = run(_die, [1])
    assert died == Failure("the process died (exit code -9)")


def test_a_job_that_dies_or_hangs_harms_no_other():
    found = dict(run(_square_or_fail, range(8), seconds=3, processes=2))
    assert {n for n, result in found.items() if result == n * n} == {0, 1, 3, 4, 6, 7}
    assert isinstance(found[2], Failure)
    assert "exit code 7" in found[2].cause
    assert isinstance(found[5], Failure)
    assert "end" in found[5].cause


def test_a_fault_in_the_task_is_raised():
    with pytest.raises(RuntimeError, match="ZeroDivisionError"):
        list(run(_divide, [0]))
