"""The child processes that do jobs on mesh files and on USD: each started once, and ended with this process."""

import atexit
import os
import subprocess
import threading
from dataclasses import field
from typing import BinaryIO, cast

from twinform.child_python import python_command
from twinform.dataclass import dataclass
from twinform.passes.mesh_jobs.job import MEMORY, BadMessageError, MeshJob, MeshResult

# Seconds of the wall clock, on a busy machine, after which a job is given up; its limit of
# processor time is shorter.
_PATIENCE = 900.0
# A pool of threads reserves address space for each processor, which counts against the limit.
_ONE_THREAD = dict.fromkeys(
    ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS", "PXR_WORK_THREAD_LIMIT"), "1"
)


@dataclass(slots=True)
class MeshProcess:
    """A child process that does one job after the other; a crash loses only the job that caused it.

    `libraries` is empty, or `usd` for jobs on USD.
    """

    memory: int = MEMORY
    seconds: float = _PATIENCE
    libraries: str = ""
    _child: "subprocess.Popen[bytes] | None" = None
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def do(self, job: MeshJob) -> MeshResult:
        """The result of a job, done by the child process."""
        with self._lock:
            late = threading.Event()
            try:
                child = self._running_child()
                timer = _start_timer(self.seconds, child, late)
            except (OSError, RuntimeError) as error:  # RuntimeError: the machine refuses another thread
                why = f"the process that looks into it cannot be started ({getattr(error, 'strerror', error)})"
                return MeshResult({}, trouble="unreadable", message=why)
            try:
                return _ask_child(child, job)
            except (OSError, BadMessageError):
                self.end()
                why = f"it takes longer than {self.seconds:g} seconds" if late.is_set() else _DEATH
                return MeshResult({}, trouble="unreadable", message=why)
            except BaseException:  # interrupted: what it would still answer is for nobody
                self.end()
                raise
            finally:
                timer.cancel()

    def end(self) -> None:
        """End the child process, if there is one."""
        if self._child is not None:
            self._child.kill()
            self._child.communicate()
            self._child = None

    def _running_child(self) -> "subprocess.Popen[bytes]":
        """The child process, started if there is none or if it has died."""
        if self._child is not None and self._child.poll() is not None:
            self.end()  # it has died since, and its pipes are still open
        if self._child is None:
            # Not a pool of the standard library: worker processes of `batch` may not have children
            # of that kind.
            self._child = subprocess.Popen(  # noqa: S603 - our own module
                python_command("-m", "twinform.passes.mesh_jobs.child", str(self.memory), *self.libraries.split()),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env={**os.environ, **_ONE_THREAD},
            )
        return self._child


_DEATH = "the process that looks into it died, as it does where it needs too much memory"


def _start_timer(seconds: float, child: "subprocess.Popen[bytes]", late: threading.Event) -> threading.Timer:
    """A running timer that gives a child up after some seconds."""
    timer = threading.Timer(seconds, _give_up, (child, late))
    timer.daemon = True
    timer.start()
    return timer


def _give_up(child: "subprocess.Popen[bytes]", late: threading.Event) -> None:
    """Kill a child, and note that it was late."""
    late.set()
    child.kill()


def _ask_child(child: "subprocess.Popen[bytes]", job: MeshJob) -> MeshResult:
    """Send a job to the child, and wait for its result."""
    if child.stdin is None or child.stdout is None:
        raise OSError("it has no pipes")
    child.stdin.write(job.to_bytes())
    child.stdin.flush()
    return MeshResult.read(cast("BinaryIO", child.stdout))


_shared, _usd = MeshProcess(), MeshProcess(libraries="usd")
atexit.register(_shared.end)
atexit.register(_usd.end)


def shared() -> MeshProcess:
    """The child process that all passes share."""
    return _shared


def usd() -> MeshProcess:
    """The child process for jobs on USD."""
    return _usd


def do(job: MeshJob) -> MeshResult:
    """The result of a job, done by the shared child process."""
    return _shared.do(job)
