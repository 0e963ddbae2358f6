"""Processes that may die."""

import os
import signal
import time
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from typing import Any

import pytest

from twinform.compiler.workers import Failure, ProcessExecutor, Runner, UnavailableError, process_runner, run, run_on

pytestmark = pytest.mark.slow


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


def test_a_job_that_is_late_is_distinguished_from_one_that_died() -> None:
    late = dict(run(_linger, [0.0, 600.0], seconds=2, processes=1))
    assert late == {0.0: 0.0, 600.0: Failure("did not come to an end", late=True)}
    ((_, died),) = run(_die, [1])
    # with no exit code where it died while it held the pipe of all, and they were started anew
    assert died in {Failure("the process died (exit code -9)"), Failure("the process died")}


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


def _die_if_told(number: int) -> int:
    if number == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.05)  # the first process to start has died before the others are done
    return number


def _own_number(_: int) -> int:
    return os.getpid()


def test_an_executor_that_breaks_is_replaced_and_only_the_job_that_broke_it_is_given_up() -> None:
    opened: list[ProcessPoolExecutor] = []

    def open_() -> ProcessPoolExecutor:
        opened.append(ProcessPoolExecutor(2, get_context("spawn")))
        return opened[-1]

    found = dict(run_on(Runner(open=open_, window=4), _die_if_told, range(8)))
    assert found == {**{number: number for number in range(8)}, 0: Failure("the process died")}
    assert 1 < len(opened) <= 6


def test_an_executor_of_the_caller_is_used_and_left_open() -> None:
    with ThreadPoolExecutor(2) as executor:
        assert dict(run_on(Runner.of(executor), _divide, [1, 2])) == {1: 1.0, 2: 0.5}
        assert executor.submit(_divide, 4).result() == 0.25
    with pytest.raises(BrokenExecutor), ProcessPoolExecutor(1, get_context("spawn")) as executor:
        list(run_on(Runner.of(executor), _die, [1, 2]))


def test_without_jobs_nothing_is_opened() -> None:
    def open_() -> ThreadPoolExecutor:
        raise AssertionError

    assert list(run_on(Runner(open=open_, window=1), _divide, [])) == []


def test_what_cannot_be_handed_over_is_said() -> None:
    with pytest.raises(RuntimeError, match="<lambda>"):  # each Python has its own words for it
        list(run(_divide, [lambda: 1]))  # type: ignore[list-item] - the point is that it cannot be sent


def test_a_pool_that_loses_an_idle_process_is_replaced() -> None:
    class Lossy(ProcessExecutor):
        broken = 0

        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Any:
            if not Lossy.broken:
                Lossy.broken += 1
                raise BrokenExecutor("Unexpected error within the Pool")
            return super().submit(fn, *args, **kwargs)

    runner = Runner(open=lambda: Lossy(1, 60), window=2)
    assert dict(run_on(runner, _divide, [1, 2])) == {1: 1.0, 2: 0.5}


def test_processes_give_way_to_new_ones_before_their_memory_grows() -> None:
    runner = Runner(open=lambda: ProcessExecutor(1, 60, most_jobs=2), window=2)
    assert len({number for _, number in run_on(runner, _own_number, range(6))}) == 3


class _Deadly:
    """A task that ends every process which it comes along with."""

    def __call__(self, number: int) -> int:
        return number

    def __reduce__(self) -> tuple[Any, tuple[int]]:
        return os._exit, (3,)


def test_no_job_is_blamed_for_processes_that_die_while_they_start() -> None:
    with pytest.raises(BrokenExecutor, match="die while they start"):
        list(run_on(process_runner(2), _Deadly(), [1, 2, 3]))


def test_no_more_processes_start_than_there_are_jobs(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def note(count: int, *_: object) -> None:
        asked.append(count)
        raise RuntimeError

    monkeypatch.setattr("twinform.compiler.workers.ProcessPool", note)
    for jobs in (1, 3, 200):
        with pytest.raises(RuntimeError):
            list(run_on(process_runner(100).for_jobs(jobs), _divide, range(jobs)))
    assert asked == [1, 3, 100]


def test_an_executor_that_cannot_be_waited_for_any_longer_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    class Silent(ThreadPoolExecutor):
        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            return Future()

    looks: list[Executor] = []

    def look(executor: Executor) -> None:
        looks.append(executor)
        if len(looks) == 3:
            raise UnavailableError("nobody is there")

    monkeypatch.setattr("twinform.compiler.workers._PAUSE", 0.01)
    with pytest.raises(UnavailableError, match="nobody is there"):
        list(run_on(Runner(open=Silent, window=4, check=look), _divide, [1, 2]))
    assert len(looks) == 3


def test_an_executor_that_cannot_be_opened_is_tried_again() -> None:
    opened: list[int] = []

    def open_() -> ThreadPoolExecutor:
        opened.append(1)
        if len(opened) < 3:
            raise OSError("nobody answers")
        return ThreadPoolExecutor(1)

    assert dict(run_on(Runner(open=open_, window=1, lost=(OSError,)), _divide, [1])) == {1: 1.0}
    with pytest.raises(UnavailableError, match="6 times in a row"):
        list(run_on(Runner(open=_unavailable, window=1, lost=(OSError,)), _divide, [1]))


def _unavailable() -> ThreadPoolExecutor:
    raise OSError("nobody answers")
