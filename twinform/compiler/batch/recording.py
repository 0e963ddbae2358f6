"""Finds the models in which nothing has changed, keeps the results of a run, and merges those of several.

A result of an earlier run is removed only after a verdict on the model itself: it was converted into other files, or
what was read has errors. A crash, a time limit, a file that cannot be read, or a disk that is gone or full say nothing
about the model, so its results stay.
"""

import errno
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from twinform.compiler.batch.entries import ModelEntry, ResultPlaces
from twinform.compiler.batch.manifest import FOLDER, Manifest, read_records
from twinform.compiler.batch.record import ModelRecord, ModelResult, Outcome
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.dependencies import (
    Dependency,
    DependencyKind,
    are_current,
    are_same,
    has_other_variables,
    is_there,
    renewed,
    stamp,
    status,
)
from twinform.compiler.observing import digest
from twinform.storage.writing import is_below, is_stream, write_all_atomically

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
        if has_other_variables(record.variables):
            return False
        return are_current(
            record.dependencies, self._root, noted=record.time, status=self._status, contents=self._contents
        )


def request_of(request: str, entry: ModelEntry) -> str:
    """Return the digest of the request for one model, with its file and arguments if it has its own."""
    own = [entry.path, *entry.arguments] if entry.arguments or entry.path != entry.name else []
    return digest(f"{request}{own}".encode(errors="surrogateescape")) if own else request


_FULL = frozenset({errno.ENOSPC, errno.EDQUOT})


class Recorder:
    """Puts results in their places, and keeps the record of each model."""

    def __init__(self, request: str, manifest: Manifest | None, places: ResultPlaces | None, shown: str = "") -> None:
        self.request, self.manifest = request, manifest
        self._places, self._shown = places, shown

    def record(self, task: Task, done: Done) -> ModelResult:
        """Put the results of a task in their places and keep its record.

        Raises:
            OSError: the disk is full or gone, or the manifest cannot be written.
        """
        self._require_in_place()
        if done.known and task.known:
            record = replace(task.known, dependencies=done.dependencies or (), time=done.time)
        else:
            record = self._supersede(self._put_results(task, done, self._make_record(task, done)))
        if self.manifest is not None:
            self.manifest.add(record)
        return ModelResult(record, known=done.known)

    def note(self, known: Known) -> ModelResult:
        """Keep the record of an earlier run if it is not the last one in the manifest.

        Raises:
            OSError: the manifest cannot be written.
        """
        if self.manifest is not None and not known.is_last:
            self.manifest.add(known.record)
        return ModelResult(known.record, known=True)

    def _require_in_place(self) -> None:
        if self.manifest is not None:
            self.manifest.require_in_place()

    def _make_record(self, task: Task, done: Done) -> ModelRecord:
        record = ModelRecord(
            source=task.entry.name,
            request=request_of(self.request, task.entry),
            outcome=done.outcome,
            output=task.output,
            dependencies=done.dependencies or (),
            variables=done.variables,
            time=done.time,
            message=done.message,
            diagnostics=done.diagnostics,
            ledger=done.ledger,
            details=done.details,
        )
        if not self._shown:
            return record
        texts = (record.message, record.diagnostics, record.details)
        message, diagnostics, details = _rename_folder(texts, task.root, self._shown)
        return replace(record, message=message, diagnostics=diagnostics, details=details)

    def _put_results(self, task: Task, done: Done, record: ModelRecord) -> ModelRecord:
        places = self._places
        if places is None or done.outcome is not Outcome.CONVERTED:
            return record
        made = {name: _digest(text) for name, text in done.texts.items()}
        problem = places.problem(task.entry.name, done.texts)
        if problem is None and self.manifest is not None:
            announced = tuple(Dependency(name, DependencyKind.READ, digest=digest) for name, digest in made.items())
            self.manifest.announce(record.source, announced)
        problem = problem or _write_results(places.dest, done.texts, self._require_in_place)
        if problem is not None:
            return replace(record, outcome=Outcome.UNWRITTEN, message=f"it cannot be written: {problem}")
        places.take(done.texts)
        results = tuple(stamp(places.dest / name, name, digest) for name, digest in made.items())
        return replace(record, results=results)

    def _supersede(self, record: ModelRecord) -> ModelRecord:
        before = self.manifest.get(record.source) if self.manifest else None
        if before is None or self._places is None:
            return record
        return _supersede_results(self._places.dest, before, record)


def _write_results(dest: Path, texts: Mapping[str, str | bytes], require_in_place: Callable[[], None]) -> str | None:
    """Write results; return the reason where that is impossible.

    Raises:
        OSError: the disk is full or gone, which it will be for the others too.
    """
    try:
        # Waiting for the disk took 7 ms per model, in the one process that writes. A power cut may leave an empty file:
        # its size is not the one in the manifest, so it is made again.
        # What is written first makes missing folders, and would make `dest` anew where its disk went at this moment.
        write_all_atomically({dest / name: text for name, text in texts.items()}, require_in_place, durably=False)
    except OSError as error:
        require_in_place()
        if error.errno in _FULL:
            raise
        return error.strerror or str(error)
    return None


def _digest(text: str | bytes) -> str:
    return digest(text if isinstance(text, bytes) else text.encode())


def _rename_folder(texts: Any, root: str, shown: str) -> Any:
    """Return the data with `shown` in place of the folder of the models, in every text in it."""
    return json.loads(json.dumps(texts).replace(json.dumps(root)[1:-1], json.dumps(shown)[1:-1]))


def _supersede_results(dest: Path, before: ModelRecord, record: ModelRecord) -> ModelRecord:
    """Remove results that a new record makes obsolete, unless somebody has edited them; else note that they stay."""
    old = before.standing
    if old is None:
        return record
    if _is_verdict(old, record):
        now = {each.path for each in record.results}
        _remove_unedited(dest, (each for each in old.results if each.path not in now))
        return record
    # Once, a crash or a disk that was not mounted cost 347 results of a finished run. The record
    # keeps that of the standing result, so a run after the disk is back finds everything as it was.
    return replace(record, kept=old if any(is_there(each, str(dest)) for each in old.results) else None)


def _is_verdict(old: ModelRecord, record: ModelRecord) -> bool:
    """Return whether a record is about the model itself, and about all files that the old results were made from."""
    if record.outcome is Outcome.CONVERTED:
        return True
    # Half a file is unreadable while somebody copies it. Without dependencies something failed, or changed on the way.
    if record.outcome is not Outcome.REFUSED or not record.dependencies:
        return False
    gone = {each.path for each in record.dependencies if each.kind is DependencyKind.ABSENT}
    # an included model that was there and is not may be on a disk that is not mounted
    return not any(each.path in gone for each in old.dependencies if each.kind is not DependencyKind.ABSENT)


def _remove_unedited(dest: Path, results: Iterable[Dependency]) -> None:
    for each in results:
        path = dest / each.path
        if is_below(path.parent, dest) and are_same([each], str(dest)):
            with suppress(OSError):
                path.unlink()


def merge(dest: Path, others: list[Path]) -> int:
    """Take over the results of other folders, make one manifest of all shards, and return the number of models.

    A result is copied if it matches its record. Of two records of a model, the later one counts.

    Raises:
        BusyError: a run is at work in the folder.
        OSError: something cannot be read or written.
    """
    with Manifest(dest).open() as manifest:
        for other in others:
            for path in _find_manifests(other):
                for record in read_records(path):
                    known = manifest.get(record.source)
                    if known is None or known.time < record.time:
                        _take_over(record, known, other, manifest)
    with Manifest(dest).open() as manifest:
        manifest.tidy()
        return len(manifest)


def _find_manifests(folder: Path) -> list[Path]:
    found = sorted(path for path in (folder / FOLDER).glob("manifest*.jsonl") if path.is_file())
    if not found:
        raise FileNotFoundError(2, "there is no manifest in it", str(folder))
    return found


def _take_over(record: ModelRecord, known: ModelRecord | None, other: Path, manifest: Manifest) -> None:
    """Copy the results of a record and remove what it makes obsolete, unless they do not match the record."""
    dest = manifest.folder.parent
    results = _copy_results(record.results, other, dest)
    if results is None:
        return
    kept = record.kept and _copy_results(record.kept.results, other, dest)
    record = replace(record, results=results, kept=replace(record.kept, results=kept) if record.kept and kept else None)
    manifest.add(_supersede_results(dest, known, record) if known else record)


def _copy_results(results: Sequence[Dependency], other: Path, dest: Path) -> tuple[Dependency, ...] | None:
    """Copy results, all or none; return them with their new status, or None if they have changed or have no place."""
    if not are_same(results, str(other)):
        return None
    for each in results:
        source, target = other / each.path, dest / each.path
        if not is_below(source, other) or not is_below(target, dest) or is_stream(target):
            return None
    write_all_atomically({dest / each.path: (other / each.path).read_bytes() for each in results}, durably=False)
    return tuple(stamp(dest / each.path, each.path, each.digest) for each in results)
