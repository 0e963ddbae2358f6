"""Records what came of a model: puts results in their places, takes away old ones, and adds to the manifest."""

import errno
import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from twinform.compiler.batch.dependencies import Dependency, DependencyKind, stamp
from twinform.compiler.batch.manifest import Manifest
from twinform.compiler.batch.places import ResultPlaces
from twinform.compiler.batch.planning import Known, request_of
from twinform.compiler.batch.record import ModelRecord, Outcome
from twinform.compiler.batch.superseding import supersede
from twinform.compiler.batch.task import Done, Task
from twinform.compiler.observing import digest
from twinform.storage.writing import write_all_atomically

_FULL = frozenset({errno.ENOSPC, errno.EDQUOT})


class ModelResult(NamedTuple):
    """What came of a model, and whether that was known before."""

    record: ModelRecord
    known: bool


class Recorder:
    """Writes down what comes back."""

    def __init__(self, request: str, manifest: Manifest | None, places: ResultPlaces | None, shown: str = "") -> None:
        self.request, self.manifest = request, manifest
        self._places, self._shown = places, shown

    def record(self, task: Task, done: Done) -> ModelResult:
        """Put results in their places and keep the record.

        Raises:
            OSError: the disk is full or gone, or the manifest cannot be written.
        """
        if self.manifest is not None:
            self.manifest.require_in_place()
        if done.known and task.known:
            record = replace(task.known, dependencies=done.dependencies or (), time=done.time)
        else:
            record = self._superseding(self._put_results(task, done, self._fresh(task, done)))
        if self.manifest is not None:
            self.manifest.add(record)
        return ModelResult(record, known=done.known)

    def note(self, known: Known) -> ModelResult:
        """Keep the record of an earlier run, where another one came after it or the results were touched.

        Raises:
            OSError: the manifest cannot be written.
        """
        if self.manifest is not None and not known.is_last:
            self.manifest.add(known.record)
        return ModelResult(known.record, known=True)

    def _fresh(self, task: Task, done: Done) -> ModelRecord:
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
        message, diagnostics, details = _renamed(texts, task.root, self._shown)
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
        problem = problem or _write_results(places.dest, done.texts)
        if problem is not None:
            return replace(record, outcome=Outcome.UNWRITTEN, message=f"it cannot be written: {problem}")
        places.take(done.texts)
        results = tuple(stamp(places.dest / name, name, digest) for name, digest in made.items())
        return replace(record, results=results)

    def _superseding(self, record: ModelRecord) -> ModelRecord:
        before = self.manifest.get(record.source) if self.manifest else None
        if before is None or self._places is None:
            return record
        return supersede(self._places.dest, before, record)


def _write_results(dest: Path, texts: Mapping[str, str | bytes]) -> str | None:
    """Write results; gives the reason where that cannot be done.

    Raises:
        OSError: the disk is full, which it will be for the others too.
    """
    try:
        # a power cut may leave an empty file, which has not the size that is in the manifest, and is made again
        # Waiting for the disk took 7 ms per model, in the one process that writes.
        write_all_atomically({dest / name: text for name, text in texts.items()}, durably=False)
    except OSError as error:
        if error.errno in _FULL:
            raise
        return error.strerror or str(error)
    return None


def _digest(text: str | bytes) -> str:
    return digest(text if isinstance(text, bytes) else text.encode())


def _renamed(texts: Any, root: str, shown: str) -> Any:
    """Return the data with `shown` in place of the folder of the models, in every text in it."""
    return json.loads(json.dumps(texts).replace(json.dumps(root)[1:-1], json.dumps(shown)[1:-1]))
