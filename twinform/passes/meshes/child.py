"""`python -m twinform.passes.meshes.child`: does jobs on mesh files, with limits on memory, until its input ends.

Mesh files are untrusted, and the libraries that read them are large: what goes wrong here is the end of this process
and not of the one that asked.
"""

import os
import select
import sys
import threading
from contextlib import suppress
from typing import BinaryIO

from twinform.passes.analyses.mesh_files import RefusedMeshError
from twinform.passes.meshes.job import Job, Result

_LIBRARIES = frozenset({"coacd", "collada", "fast_simplification", "numpy", "scipy", "trimesh"})
"""What the extra brings, as it is imported."""


def _limit_memory(limit: int) -> None:
    with suppress(ImportError, ValueError, OSError):  # there are no such limits, or a stricter one is set
        import resource  # noqa: PLC0415 - not everywhere

        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def done(job: Job) -> Result:
    """What comes of a job; no fault of a mesh or of a library gets out."""
    try:
        from twinform.passes.meshes.geometry.jobs import JOBS  # noqa: PLC0415 - the libraries may not be installed

        return JOBS[job.name](job)
    except ImportError as error:
        library = (error.name or "").partition(".")[0]
        if library not in _LIBRARIES:  # one that a reader would like to have for files as odd as this
            return Result({}, trouble="unreadable", message=f"no reader takes it ({error})")
        return Result({}, trouble="missing", message=library)
    except MemoryError:
        return Result({}, trouble="unreadable", message="it needs more memory than it may have")
    except RefusedMeshError as error:
        return Result({}, trouble="unreadable", message=str(error))
    except Exception as error:  # noqa: BLE001 - readers of six formats raise whatever they like
        message = f"its reader stops at it ({type(error).__name__}: {error})"
        return Result({}, trouble="unreadable", message=message)


def _replies() -> BinaryIO:
    """Where results go; what libraries print goes nowhere."""
    own = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, sys.stdout.fileno())
    os.dup2(silence, sys.stderr.fileno())
    return own


def _end_with_parent() -> None:
    """Wait until nobody can write to standard input any more, and end this process, also in the middle of a job."""
    hung_up = select.poll()
    hung_up.register(sys.stdin.fileno(), 0)  # that it is closed at the other end is reported in any case
    hung_up.poll()
    os._exit(1)


def main() -> None:
    """Do jobs until there are no more."""
    if hasattr(select, "poll"):  # Windows has none
        threading.Thread(target=_end_with_parent, daemon=True).start()
    _limit_memory(int(sys.argv[1]))
    replies = _replies()
    while (job := Job.read(sys.stdin.buffer)) is not None:
        replies.write(done(job).to_bytes())
        replies.flush()


if __name__ == "__main__":
    main()
