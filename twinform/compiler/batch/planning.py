"""Plans a batch: finds the models in which nothing has changed, by the status of their files."""

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from twinform.compiler.batch.dependencies import Dependency, are_current, renewed, status
from twinform.compiler.batch.entries import ModelEntry
from twinform.compiler.batch.manifest import Manifest
from twinform.compiler.batch.record import ModelRecord, Outcome
from twinform.compiler.observing import digest

# The most paths of which the status is kept: several models share macro libraries, meshes and
# folders.
_MOST_REMEMBERED = 2**16


class Known(NamedTuple):
    """The record of an earlier run, and whether it is the last one of its model in the manifest."""

    record: ModelRecord
    is_last: bool


class BatchPlan:
    """What is known of the models of a run from earlier ones."""

    def __init__(
        self,
        request: str,
        root: str,
        dest: Path | None,
        manifest: Manifest | None,
        *,
        fresh: bool = False,
        contents: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._request, self._root, self._dest = request, root, str(dest or "")
        self._manifest, self._fresh, self._contents = manifest, fresh, contents
        self._status = lru_cache(_MOST_REMEMBERED)(status)

    def known(self, entry: ModelEntry, output: str) -> Known | None:
        """Return the record of a model if it still counts, as far as can be seen without opening any file."""
        return next((each for each in self._candidates(entry, output) if self._is_current(each.record)), None)

    def candidate(self, entry: ModelEntry, output: str) -> ModelRecord | None:
        """Return the record of a model if the request is the same, and only the content of files has to be compared."""
        return next((each.record for each in self._candidates(entry, output)), None)

    def _candidates(self, entry: ModelEntry, output: str) -> Iterator[Known]:
        """Yield the last record of a model, and that of the results that are still in place, if they may count."""
        last = self._manifest.get(entry.name) if self._manifest and not self._fresh else None
        for record in (last, last and last.kept):
            if record is None or (record.request, record.output) != (request_of(self._request, entry), output):
                continue
            is_whole = bool(record.dependencies) and (record.outcome is not Outcome.CONVERTED or bool(record.results))
            results = self._check_results(record) if is_whole and record.outcome.is_final else None
            if results is not None:
                yield Known(replace(record, results=results), record is last and results is record.results)

    def _check_results(self, record: ModelRecord) -> tuple[Dependency, ...] | None:
        """Return the results of a record with their status now; None if one is not what was written."""
        # the status of a result is asked once, and not kept
        if are_current(record.results, self._dest):
            return record.results
        return renewed(record.results, self._dest)

    def _is_current(self, record: ModelRecord) -> bool:
        if any(os.environ.get(name) != value for name, value in record.variables.items()):
            return False
        return are_current(
            record.dependencies, self._root, noted=record.time, status=self._status, contents=self._contents
        )


def request_of(request: str, entry: ModelEntry) -> str:
    """Return the digest of the request for one model, with its file and arguments if it has its own."""
    own = [entry.path, *entry.arguments] if entry.arguments or entry.path != entry.name else []
    return digest(f"{request}{own}".encode(errors="surrogateescape")) if own else request
