"""Puts the results and records of several runs together: of shards in one folder, or of other folders."""

import shutil
from pathlib import Path

from twinform.compiler.batch.dependencies import are_same
from twinform.compiler.batch.manifest import FOLDER, Manifest, read_records
from twinform.compiler.batch.record import Record
from twinform.compiler.output.same_files import is_below
from twinform.storage.writing import is_stream


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
                    if (known is None or known.time < record.time) and _copied(record, other, dest):
                        manifest.add(record)
    with Manifest(dest).open() as manifest:
        manifest.merge()
        return len(manifest)


def _manifests(folder: Path) -> list[Path]:
    found = sorted(path for path in (folder / FOLDER).glob("manifest*.jsonl") if path.is_file())
    if not found:
        raise FileNotFoundError(2, "there is no manifest in it", str(folder))
    return found


def _copied(record: Record, other: Path, dest: Path) -> bool:
    """Copy the results of a record, all or none; False where they do not match it, or have no place."""
    if not are_same(record.results, str(other)):
        return False
    for each in record.results:
        source, target = other / each.path, dest / each.path
        if not is_below(source, other) or not is_below(target, dest) or is_stream(target):
            return False
    for each in record.results:
        target = dest / each.path
        target.parent.mkdir(parents=True, exist_ok=True)
        new = target.with_name(f".{target.name}.new")
        shutil.copy2(other / each.path, new, follow_symlinks=False)
        new.replace(target)
    return True
