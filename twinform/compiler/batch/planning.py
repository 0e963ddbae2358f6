"""Plans a batch: which models are as they were, by the status of their files."""

import os
from functools import lru_cache
from pathlib import Path

from twinform.compiler.batch.dependencies import are_current, status
from twinform.compiler.batch.entries import Entry
from twinform.compiler.batch.manifest import Manifest
from twinform.compiler.batch.record import Outcome, Record
from twinform.compiler.observing import digest

_MOST_REMEMBERED = 2**16
"""Paths that several models share: libraries of macros, meshes, folders."""


class Plan:
    """What is known of the models of a run."""

    def __init__(
        self, request: str, root: str, dest: Path | None, manifest: Manifest | None, *, fresh: bool = False
    ) -> None:
        self._request, self._root, self._dest = request, root, str(dest or "")
        self._manifest, self._fresh = manifest, fresh
        self._status = lru_cache(_MOST_REMEMBERED)(status)

    def known(self, entry: Entry, output: str) -> Record | None:
        """What came of a model in an earlier run, if nothing has changed that can be seen without opening a file."""
        record = self.candidate(entry, output)
        if record is None or any(os.environ.get(name) != value for name, value in record.variables.items()):
            return None
        # the status of a result is asked once, and not kept
        if not are_current(record.results, self._dest):
            return None
        same = are_current(record.dependencies, self._root, noted=record.time, status=self._status)
        return record if same else None

    def candidate(self, entry: Entry, output: str) -> Record | None:
        """What came of a model in an earlier run, if what is asked for is the same and might end the same way."""
        record = self._manifest.get(entry.name) if self._manifest and not self._fresh else None
        if record is None or (record.request, record.output) != (request_of(self._request, entry), output):
            return None
        is_whole = bool(record.dependencies) and (record.outcome is not Outcome.CONVERTED or bool(record.results))
        return record if is_whole and record.outcome.is_final else None


def request_of(request: str, entry: Entry) -> str:
    """The request for one model, with its file and its arguments where these are its own."""
    own = [entry.path, *entry.arguments] if entry.arguments or entry.path != entry.name else []
    return digest(f"{request}{own}".encode(errors="surrogateescape")) if own else request
