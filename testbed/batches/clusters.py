"""A scheduler of Dask with workers that are killed while a campaign runs on them."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

from testbed.batches.campaign import Campaign

_OTHER = "0.0.1"


@dataclass(slots=True)
class Cluster:
    """A scheduler and its workers, each of which is started anew when it has been killed."""

    port: int
    scheduler: "subprocess.Popen[bytes] | None" = None
    workers: "list[subprocess.Popen[bytes]]" = field(default_factory=list["subprocess.Popen[bytes]"])

    @property
    def address(self) -> str:
        """Where the scheduler is."""
        return f"tcp://127.0.0.1:{self.port}"

    def start_scheduler(self) -> None:
        """Start the scheduler."""
        self.scheduler = _dask("scheduler", "--host", "127.0.0.1", "--port", str(self.port), "--no-dashboard")

    def start_worker(self, **environment: str) -> None:
        """Start one more worker."""
        words = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", "scratch")
        self.workers.append(_dask("worker", self.address, *words, **environment))

    def kill_worker(self) -> None:
        """Kill the oldest worker."""
        _kill(self.workers.pop(0))

    def kill_scheduler(self) -> None:
        """Kill the scheduler."""
        if self.scheduler is not None:
            _kill(self.scheduler)

    def stop(self) -> None:
        """End all."""
        self.kill_scheduler()
        while self.workers:
            self.kill_worker()


@contextmanager
def cluster(workers: int) -> Generator[Cluster]:
    """A cluster on this machine."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        made = Cluster(found.getsockname()[1])
    try:
        made.start_scheduler()
        for _ in range(workers):
            made.start_worker()
        yield made
    finally:
        made.stop()


def kill_cluster_workers(campaign: Campaign, made: Cluster, times: int) -> None:
    """Kill workers of the cluster in the middle of a run, one after the other."""
    with campaign.event("workers of Dask are killed"):
        process = campaign.start("--scheduler", made.address, "--fresh")
        for _ in range(times):
            campaign.wait(process, part=0.5)
            made.start_worker()
            made.kill_worker()
            campaign.tally.kills["workers of Dask"] += 1
        campaign.finish(process)


def kill_scheduler(campaign: Campaign, made: Cluster) -> None:
    """Kill the scheduler with its workers in the middle of a run, and start others."""
    with campaign.event("the scheduler is killed"):
        process = campaign.start("--scheduler", made.address, "--fresh")
        campaign.wait(process)
        count = len(made.workers)
        made.stop()
        campaign.tally.kills["schedulers"] += 1
        campaign.tally.kills["workers of Dask"] += count
        time.sleep(campaign.chance.random())
        made.start_scheduler()
        for _ in range(count):
            made.start_worker()
        campaign.finish(process)


def mix_versions(campaign: Campaign, made: Cluster) -> None:
    """Let a worker of another version join, before a run or in the middle of it: the run must end, or not meet it."""
    with campaign.event("versions are mixed"):
        is_late = campaign.chance.random() < 0.5
        other = campaign.site(OTHER_VERSION=_OTHER)
        if is_late:
            process = campaign.start("--scheduler", made.address, "--fresh")
            campaign.wait(process)
            made.start_worker(**other)
        else:
            made.start_worker(**other)
            time.sleep(5)
            process = campaign.start("--scheduler", made.address, "--fresh")
        errors = campaign.finish(process)
        _kill(made.workers.pop())
        if process.returncode == 2:
            campaign.tally.kills["runs that end because of a version"] += f"has twinform {_OTHER}" in errors
            campaign.tally.kills["runs that end because of a version"] += f"this is twinform {_OTHER}" in errors


def _dask(*words: str, **environment: str) -> "subprocess.Popen[bytes]":
    nothing = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-m", "dask", *words],
        stdout=nothing,
        stderr=nothing,
        start_new_session=True,
        env={**os.environ, **environment},
    )


def _kill(process: "subprocess.Popen[bytes]") -> None:
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
