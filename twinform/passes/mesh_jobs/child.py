"""`python -m twinform.passes.mesh_jobs.child`: does jobs on mesh files, or on USD, until its input ends.

These files are untrusted, and the libraries that read them are large. On Linux a fork of this process does each job: it
has imported the libraries already, and has limited time and memory, no files, no connections and no child processes.
Whatever goes wrong there ends only the fork. On other systems the job is do_job here, with a limit on memory.
"""

import os
import select
import signal
import sys
import tempfile
import threading
from collections.abc import Generator
from contextlib import contextmanager, suppress
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import BinaryIO

from twinform.confinement import confine
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult, limit_reading, reading_seconds
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError

_JOBS = {
    "count": "measuring", "convert": "mesh_making", "decimate": "mesh_making", "draw": "measuring",
    "image": "image_making", "measure": "measuring", "simplify": "mesh_making", "surface": "measuring",
}  # fmt: skip
"""The module that has the function of a job, which has the name of the job."""
_USD_JOBS = {"layer": "usd_jobs", "stage": "usd_jobs"}
"""The jobs on USD, of a process of their own: its library takes a third of a second to import."""
# A stage of a megabyte has 1,500 links, and takes a second to compose and to tell.
_HEAVIER = {"layer": 8, "stage": 16}
"""How many times as long the reader of USD takes for a text as those of meshes, and how much more memory."""
_LIBRARIES = frozenset({"coacd", "collada", "fast_simplification", "numpy", "PIL", "pxr", "scipy", "trimesh"})
"""The import names of the libraries that the extra installs."""
# Readers import these when they meet certain files, and could not do so once the process is
# confined.
_NEEDED_LATER = (
    "charset_normalizer", "collada", "lxml.etree", "PIL.Image", "scipy.optimize", "scipy.spatial",
    "trimesh.exchange.load", "unicodedata", "encodings.idna", "encodings.latin_1", "encodings.utf_16",
    "encodings.cp437",
)  # fmt: skip
_LONGEST = 500
"""Characters of a message of a library, which may repeat the file."""
_SET_DEATH_SIGNAL = 1
"""PR_SET_PDEATHSIG of prctl(2)."""


def main() -> None:
    """Read jobs from standard input and write their results until there are no more jobs."""
    if hasattr(select, "poll"):  # Windows has none
        threading.Thread(target=_end_with_parent, daemon=True).start()
    memory, replies = int(sys.argv[1]), _open_replies()
    forks = sys.platform.startswith("linux")
    if forks:
        _import_libraries(usd=sys.argv[2:] == ["usd"])
    while (job := MeshJob.read(sys.stdin.buffer)) is not None:
        if forks:
            _do_in_fork(job, memory, replies)
        else:
            limit_reading(2**28, memory)
            replies.write((_NOT_HELD if job.kind == "usdc" else do_job(job)).to_bytes())
            replies.flush()


def _open_replies() -> BinaryIO:
    """A stream for results in the place of standard output; what libraries print is discarded."""
    own = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, sys.stdout.fileno())
    os.dup2(silence, sys.stderr.fileno())
    return own


def _end_with_parent() -> None:
    """End this process, even in the middle of a job, once nobody can write to its standard input any more."""
    hung_up = select.poll()
    hung_up.register(sys.stdin.fileno(), 0)  # that it is closed at the other end is reported in any case
    hung_up.poll()
    os._exit(1)


def _import_libraries(*, usd: bool = False) -> None:
    """Import all that a job may need, as far as it is installed."""
    # After `confine` nothing can be opened, so whatever a reader imports late has to be there.
    if usd:
        with suppress(ImportError):
            import_module("twinform.passes.mesh_jobs.usd_jobs").warm_up()
        return
    for name in (*_NEEDED_LATER, *(f"twinform.passes.mesh_jobs.{name}" for name in sorted({*_JOBS.values()}))):
        with suppress(ImportError):
            import_module(name)
    with suppress(ImportError):
        image = import_module("PIL.Image")
        image.init()  # the readers of all formats


def _do_in_fork(job: MeshJob, memory: int, replies: BinaryIO) -> None:
    """Do a job in a confined fork, which writes the result; if the fork dies, write a result that says so."""
    # A COLLADA file of 2 kB whose nodes stand for each other twice took 2.6 GB in the compiler's
    # process. In a fork, the libraries are imported already (that takes a second), and nothing that
    # a mesh does to one of them outlives its job.
    with _file_of(job) as file:
        child = os.fork()
        if not child:
            answered = False
            try:
                _end_fork_with_parent()
                limit_reading(job.size * _HEAVIER.get(job.name, 1), memory)
                # Threads for CoACD.
                held = confine(threads=True, opens=bool(file))
                is_held = not file or "landlock" in held
                replies.write((do_job(_with_file(job, file)) if is_held else _NOT_HELD).to_bytes())
                replies.flush()
                answered = True
            finally:
                os._exit(not answered)
        _, status = os.waitpid(child, 0)
    if status:
        replies.write(MeshResult({}, trouble="unreadable", message=_explain_death(status, job)).to_bytes())
        replies.flush()


_LINKED = 63
"""The descriptor that a name leads to: the highest that a confined process may open."""
_NOT_HELD = MeshResult(
    {},
    trouble="unreadable",
    message="a binary layer of USD is read only where Linux has Landlock; write it as text (usda)",
)


@contextmanager
def _file_of(job: MeshJob) -> Generator[str]:
    """A name under which a confined fork can open the content of a job; empty where its reader needs none.

    USD reads binary layers from files alone, and their format goes by the name. The name is a link to a file in memory:
    the confined process can open no file of the system, and this one is of none.
    """
    if job.kind != "usdc":
        yield ""
        return
    with tempfile.TemporaryDirectory() as folder:
        made = os.memfd_create("layer")
        try:
            with os.fdopen(os.dup(made), "wb") as copy:
                copy.write(job.content)
            os.dup2(made, _LINKED)
            name = Path(folder, "layer.usdc")
            name.symlink_to(f"/proc/self/fd/{_LINKED}")
            yield str(name)
        finally:
            os.close(made)
            os.close(_LINKED)


def _with_file(job: MeshJob, file: str) -> MeshJob:
    return replace(job, options={**job.options, "file": file}) if file else job


def _end_fork_with_parent() -> None:
    """Have the system kill this fork when its parent ends."""
    with suppress(ImportError):
        ctypes = import_module("ctypes")
        ctypes.CDLL(None).prctl(_SET_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0)


def _explain_death(status: int, job: MeshJob) -> str:
    """Why a fork ended without a result, from its exit status."""
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        return f"reading it takes more than {reading_seconds(job.size)} seconds of the processor"
    return "the process that looks into it died, as it does where it needs too much memory"


def do_job(job: MeshJob) -> MeshResult:
    """The result of a job; errors of the mesh and of the libraries become a result with `trouble`."""
    try:
        # the libraries may not be installed, and only some jobs need all of them
        module = import_module(f"twinform.passes.mesh_jobs.{(_JOBS | _USD_JOBS)[job.name]}")
        return getattr(module, job.name)(job)
    except ImportError as error:
        library = (error.name or "").partition(".")[0]
        if library not in _LIBRARIES:  # one that a reader would like to have for files as odd as this
            return MeshResult({}, trouble="unreadable", message=f"no reader takes it ({error})")
        return MeshResult({}, trouble="missing", message=library)
    except MemoryError:
        return MeshResult({}, trouble="unreadable", message="it needs more memory than it may have")
    except RefusedMeshError as error:
        return MeshResult({}, trouble="unreadable", message=str(error))
    except Exception as error:  # noqa: BLE001 - readers of six formats raise whatever they like
        message = f"its reader stops at it ({type(error).__name__}: {str(error)[:_LONGEST]})"
        return MeshResult({}, trouble="unreadable", message=message)


if __name__ == "__main__":
    main()
