"""Runs on the workers of a scheduler of Dask: the same results, whatever goes away."""

import os
import platform
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from distributed import LocalCluster

from twinform.compiler.batch.dask_runner import dask_runner
from twinform.compiler.workers import Failure, Runner, UnavailableError, run_on

from .conftest import SUMMARY, converting, finish, records, results, wait_for

pytestmark = pytest.mark.filterwarnings("ignore")  # distributed is not free of them


def _cluster(**options: Any) -> Any:
    untyped: Any = LocalCluster
    return untyped(threads_per_worker=1, host="127.0.0.1", dashboard_address=None, **options)


def _runner(cluster: Any) -> Runner:
    return dask_runner(cluster.scheduler_address)


def _double(number: int) -> int:
    return 2 * number


def _die_if_told(number: int) -> int:
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def test_jobs_run_on_a_cluster() -> None:
    with _cluster(n_workers=1, processes=False, protocol="tcp") as cluster:
        found = dict(run_on(_runner(cluster), _double, range(20)))
    assert found == {number: 2 * number for number in range(20)}


@pytest.mark.deep
def test_a_job_that_ends_every_worker_is_given_up_and_harms_no_other() -> None:
    with _cluster(n_workers=2) as cluster:
        found = dict(run_on(_runner(cluster), _die_if_told, range(8)))
    assert found == {**{number: number for number in range(8)}, 3: Failure("every worker that it was given to died")}


def test_a_scheduler_without_workers_is_waited_for_and_no_longer_than_it_may() -> None:
    told: list[str] = []
    with _cluster(n_workers=0, processes=False, protocol="tcp") as cluster:
        runner = dask_runner(cluster.scheduler_address, patience=1, tell=told.append)
        with pytest.raises(UnavailableError, match=r"a worker of the scheduler .* was waited for in vain, 1 seconds"):
            list(run_on(runner, _double, range(2)))
    assert [line.partition(" of the scheduler")[0] for line in told] == ["waiting for a worker"]


def test_a_scheduler_that_is_not_there_is_waited_for_and_no_longer_than_it_may() -> None:
    address = f"tcp://127.0.0.1:{_port()}"
    with pytest.raises(UnavailableError, match=f"the scheduler {address} was waited for in vain"):
        list(run_on(dask_runner(address, patience=1), _double, range(2)))


@pytest.mark.deep
def test_workers_that_all_go_away_in_the_middle_are_waited_for_and_no_longer_than_they_may(here: Path) -> None:
    address = f"tcp://127.0.0.1:{_port()}"
    with _started(*_scheduler(address.rpartition(":")[2])), _started(*_worker(address)) as worker:
        done = run_on(dask_runner(address, patience=8), time.sleep, [0.1] * 1000)
        next(done)
        _kill(worker)
        with pytest.raises(UnavailableError, match="a worker of the scheduler"):
            list(done)
    assert here.is_dir()


@pytest.mark.deep
@pytest.mark.parametrize("fault", ["version", "files"])
def test_a_worker_that_does_not_fit_ends_a_run_and_no_result_goes(fault: str, here: Path) -> None:
    assert finish(converting()) == SUMMARY
    before = results()
    port = _port()
    address = f"tcp://127.0.0.1:{port}"
    (here / "site").mkdir()
    (here / "site/sitecustomize.py").write_text(_OTHER_VERSION)
    other = {**os.environ, "PYTHONPATH": str(here / "site")} if fault == "version" else dict(os.environ)
    hidden = _HIDDEN if fault == "files" else ()
    if hidden and os.geteuid():
        pytest.skip("only root may hide a folder from a process")
    with _started(*_scheduler(port)), _started(*_worker(address), env=other, before=hidden):
        done = subprocess.run(
            converting("--scheduler", address, "--fresh"), capture_output=True, text=True, check=False
        )
    assert done.returncode == 2, done.stderr
    problem = next(line for line in done.stderr.splitlines() if line.startswith("Error: a worker does not fit"))
    assert f"{platform.node()} has twinform 0.0.1, and " in problem or f"{platform.node()} does not see src/" in problem
    assert ("0.0.1" in problem) == (fault == "version")
    assert results() == before


_OTHER_VERSION = """
import importlib.metadata
real = importlib.metadata.version
importlib.metadata.version = lambda name: "0.0.1" if name == "twinform" else real(name)
"""
_HIDDEN = ("unshare", "--mount", "sh", "-c", 'mount -t tmpfs tmpfs src && exec "$@"', "sh")
"""Runs a command that finds nothing in the folder of the models, as where a disk is not mounted."""


@contextmanager
def _started(
    *words: str, env: dict[str, str] | None = None, before: tuple[str, ...] = ()
) -> Generator[subprocess.Popen[bytes]]:
    """A program of Dask in a session of its own, so that it can be killed with all that it starts."""
    command = [*before, sys.executable, "-m", "dask", *words]
    nothing = subprocess.DEVNULL
    with subprocess.Popen(command, stdout=nothing, stderr=nothing, start_new_session=True, env=env) as process:
        try:
            yield process
        finally:
            _kill(process)


def _kill(process: subprocess.Popen[bytes]) -> None:
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _port() -> str:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return str(found.getsockname()[1])


def _scheduler(port: str) -> tuple[str, ...]:
    return ("scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard")


def _worker(address: str) -> tuple[str, ...]:
    return ("worker", address, "--nthreads", "1", "--no-dashboard", "--local-directory", "scratch")


@pytest.mark.deep
def test_with_workers_killed_the_results_are_the_same_bytes(here: Path) -> None:
    assert finish(converting(out="whole")) == SUMMARY
    port = _port()
    address = f"tcp://127.0.0.1:{port}"
    with _started(*_scheduler(port)), _started(*_worker(address)) as one, _started(*_worker(address)) as two:
        batch = subprocess.Popen(converting("--scheduler", address), stderr=subprocess.PIPE, text=True)
        wait_for(lambda: records() >= 10)
        _kill(one)
        wait_for(lambda: records() >= 30 or batch.poll() is not None)
        with _started(*_worker(address)):
            wait_for(lambda: records() >= 40 or batch.poll() is not None)
            _kill(two)
            _, stderr = batch.communicate(timeout=300)
    assert stderr.splitlines()[-1] == SUMMARY
    assert results() == results("whole")


@pytest.mark.deep
def test_a_scheduler_that_goes_away_and_comes_back_is_waited_for(here: Path) -> None:
    assert finish(converting(out="whole")) == SUMMARY
    port = _port()
    address = f"tcp://127.0.0.1:{port}"
    with _started(*_scheduler(port)) as scheduler, _started(*_worker(address)):
        batch = subprocess.Popen(converting("--scheduler", address), stderr=subprocess.PIPE, text=True)
        wait_for(lambda: records() >= 10)
        _kill(scheduler)
        before = records()
        assert before < 100
        with _started(*_scheduler(port)), _started(*_worker(address)):
            _, stderr = batch.communicate(timeout=300)
    assert stderr.splitlines()[-1] == SUMMARY
    assert results() == results("whole")


@pytest.mark.deep
def test_a_run_that_is_killed_on_a_cluster_is_resumed_without_it(here: Path) -> None:
    assert finish(converting(out="whole")) == SUMMARY
    port = _port()
    address = f"tcp://127.0.0.1:{port}"
    with _started(*_scheduler(port)), _started(*_worker(address)):
        batch = subprocess.Popen(converting("--scheduler", address), stderr=subprocess.DEVNULL)
        wait_for(lambda: records() >= 20)
        batch.kill()
        batch.wait()
    last = finish(converting())
    assert int(last.rpartition("(")[2].split()[0]) >= 20
    assert results() == results("whole")
