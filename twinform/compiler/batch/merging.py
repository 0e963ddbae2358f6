"""Puts the results and records of several runs together: of shards in one folder, or of other folders."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from twinform.compiler.batch.dependencies import Dependency, are_same, stamp
from twinform.compiler.batch.manifest import FOLDER, Manifest, read_records
from twinform.compiler.batch.record import ModelRecord
from twinform.compiler.batch.superseding import supersede
from twinform.compiler.output.same_files import is_below
from twinform.storage.writing import is_stream, write_all_atomically


def merge(dest: Path, others: list[Path]) -> int:
    """Take over what other folders have, and make one manifest of those of shards; gives how many models there are.

    A result is copied if it matches its record. Of two records of a model that of the later run counts.

    Raises:
        BusyError: a run is at work in the folder.
        OSError: something cannot be read or written.
    """
    with Manifest(dest).open() as manifest:
        for other in others:
            for path in _manifests(other):
                for record in read_records(path):
                    known = manifest.get(record.source)
                    if known is None or known.time < record.time:
                        _take_over(record, known, other, manifest)
    with Manifest(dest).open() as manifest:
        manifest.merge()
        return len(manifest)


def _manifests(folder: Path) -> list[Path]:
    found = sorted(path for path in (folder / FOLDER).glob("manifest*.jsonl") if path.is_file())
    if not found:
        raise FileNotFoundError(2, "there is no manifest in it", str(folder))
    return found


def _take_over(record: ModelRecord, known: ModelRecord | None, other: Path, manifest: Manifest) -> None:
    """Copy the results of a record, and take away what it makes obsolete; nothing where they do not match it."""
    dest = manifest.folder.parent
    results = _copied(record.results, other, dest)
    if results is None:
        return
    kept = record.kept and _copied(record.kept.results, other, dest)
    record = replace(record, results=results, kept=replace(record.kept, results=kept) if record.kept and kept else None)
    manifest.add(supersede(dest, known, record) if known else record)


def _copied(results: Sequence[Dependency], other: Path, dest: Path) -> tuple[Dependency, ...] | None:
    """Copy results, all or none; gives them with their new status, None where they are others or have no place."""
    if not are_same(results, str(other)):
        return None
    for each in results:
        source, target = other / each.path, dest / each.path
        if not is_below(source, other) or not is_below(target, dest) or is_stream(target):
            return None
    write_all_atomically({dest / each.path: (other / each.path).read_bytes() for each in results}, durably=False)
    return tuple(stamp(dest / each.path, each.path, each.digest) for each in results)
