"""A cache folder of the user for the results of jobs on meshes, by a digest of everything that they depend on.

It is `$XDG_CACHE_HOME/twinform/meshes`, or the folder that `TWINFORM_MESH_CACHE` names; `off` there disables it. A
result appears all at once, under a name that is its digest, so several processes may use the folder at a time.
"""

import hashlib
import io
import os
from contextlib import suppress
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Self

from twinform.passes.mesh_jobs.job import BadMessageError, MeshJob, MeshResult
from twinform.storage.writing import write_atomically

VARIABLE = "TWINFORM_MESH_CACHE"
_LIBRARIES = ("twinform", "coacd", "fast-simplification", "numpy", "pycollada", "scipy", "trimesh")
_MOST = 2**30
"""Bytes that are kept; beyond them, the results that were used longest ago are deleted."""
_DIGEST = hashlib.sha256().digest_size
FORMAT = "3"
"""Is raised when a job makes something else although no version of a library changed."""


@dataclass(frozen=True, slots=True)
class ResultsCache:
    """Results in a folder; nothing is kept if it is None."""

    folder: Path | None

    @classmethod
    def usual(cls) -> Self:
        """The cache of the user."""
        chosen = os.environ.get(VARIABLE, "")
        if chosen == "off":
            return cls(None)
        if chosen:
            return cls(Path(chosen))
        base = os.environ.get("XDG_CACHE_HOME", "")
        try:
            home = Path(base) if Path(base).is_absolute() else Path.home() / ".cache"
        except RuntimeError:  # the user has no home
            return cls(None)
        return cls(home / "twinform" / "meshes")

    def get(self, job: MeshJob) -> MeshResult | None:
        """The result of a job that was done before; None where there is none, or where it is damaged."""
        path = self._path(job)
        if path is None:
            return None
        with suppress(OSError, BadMessageError, ValueError, KeyError):
            data = path.read_bytes()
            if hashlib.sha256(data[_DIGEST:]).digest() == data[:_DIGEST]:
                os.utime(path)
                return MeshResult.read(io.BytesIO(data[_DIGEST:]))
        return None

    def put(self, job: MeshJob, result: MeshResult) -> None:
        """Keep a result; a folder that cannot be written to is no reason to fail."""
        path = self._path(job)
        if path is None or result.trouble:
            return
        data = result.to_bytes()
        with suppress(OSError):
            write_atomically(path, hashlib.sha256(data).digest() + data, durably=False)  # half a result has no digest
            _prune(path.parent)

    def _path(self, job: MeshJob) -> Path | None:
        if self.folder is not None:
            with suppress(OSError):  # which versions are installed cannot be read
                return (
                    self.folder
                    / f"{job.digest({'format': FORMAT, **{name: _version(name) for name in _LIBRARIES}})}.result"
                )
        return None


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _prune(folder: Path) -> None:
    found = [(status.st_mtime, status.st_size, path) for path in folder.iterdir() for status in [path.stat()]]
    total = sum(size for _, size, _ in found)
    for _, size, path in sorted(found):
        if total <= _MOST:
            return
        with suppress(OSError):
            path.unlink()
            total -= size
