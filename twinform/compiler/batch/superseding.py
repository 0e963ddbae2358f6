"""Which results of an earlier run go once a model has been worked on again.

A result goes only after a verdict on the model itself: it was converted into others, or what was read has errors. A
crash, a limit of time, a file that cannot be read, a disk that is gone or full say nothing about the model, so they
leave what is there as it is.
"""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from twinform.compiler.batch.dependencies import Dependency, DependencyKind, are_same, is_there
from twinform.compiler.batch.record import ModelRecord, Outcome
from twinform.compiler.output.same_files import is_below


def supersede(dest: Path, before: ModelRecord, record: ModelRecord) -> ModelRecord:
    """Take away results that a new record makes obsolete, unless somebody has edited them; else note that they stay."""
    old = before.standing
    if old is None:
        return record
    if _is_verdict(old, record):
        now = {each.path for each in record.results}
        _remove(dest, (each for each in old.results if each.path not in now))
        return record
    # Once, a crash or a disk that was not mounted cost 347 results of a finished run. The record
    # keeps that of the standing result, so a run after the disk is back finds everything as it was.
    return replace(record, kept=old if any(is_there(each, str(dest)) for each in old.results) else None)


def _is_verdict(old: ModelRecord, record: ModelRecord) -> bool:
    """Whether a record is about the model itself, and about all that the old results were made from."""
    if record.outcome is Outcome.CONVERTED:
        return True
    # Half a file is unreadable while somebody copies it. Without dependencies something failed, or changed on the way.
    if record.outcome is not Outcome.REFUSED or not record.dependencies:
        return False
    gone = {each.path for each in record.dependencies if each.kind is DependencyKind.ABSENT}
    # an included model that was there and is not may be on a disk that is not mounted
    return not any(each.path in gone for each in old.dependencies if each.kind is not DependencyKind.ABSENT)


def _remove(dest: Path, results: Iterable[Dependency]) -> None:
    for each in results:
        path = dest / each.path
        if is_below(path.parent, dest) and are_same([each], str(dest)):
            with suppress(OSError):
                path.unlink()
