"""The manifest of earlier runs: lines of JSON, of which the last one for each model counts.

Lines stay on disk, and only their offsets are in memory. Each shard of a run writes a file of its own. joblib.Memory
and diskcache keep results by their arguments: they know nothing of files that a model includes, or looks for in vain.
"""

import errno
import json
import os
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from twinform.compiler.batch.record import ModelRecord, Outcome
from twinform.compiler.dependencies import Dependency, packed, unpacked
from twinform.storage.transaction import named_after, transaction
from twinform.storage.writing import is_open_at, is_stream, refuse_way_out, sync_files

try:
    import fcntl
except ImportError:  # on Windows
    fcntl = None

FOLDER = ".twinform-batch"
_BEGIN = b'{"source": '
_DECODER = json.JSONDecoder()
_DEPENDENCIES = ("dependencies", "results")
# A file is rewritten once it has this many times the lines that count.
_TIDY = 2


class _ManifestLine(NamedTuple):
    file: int
    offset: int


class BusyError(Exception):
    """Another run is writing to the same folder of results."""


class Manifest:
    """The records in the folder of the results. A run that is killed loses nothing that was done."""

    def __init__(self, dest: Path, shard: str = "") -> None:
        self.folder = dest / FOLDER
        self._shard = shard
        self._own = self.folder / (f"manifest-{shard}.jsonl" if shard else "manifest.jsonl")
        self._files: list[BinaryIO] = []
        self._lines: dict[str, _ManifestLine] = {}
        self._count = 0
        self._log: BinaryIO | None = None
        self._journal: BinaryIO | None = None

    @contextmanager
    def open(self) -> Generator["Manifest"]:
        """Create and lock the folder, read its records, and prepare to add more.

        Raises:
            BusyError: another run is at work here.
            OSError: it cannot be written.
        """
        for path in (self.folder, self._own):
            refuse_way_out(path)
        if is_stream(self._own):
            raise FileExistsError(errno.EEXIST, "a pipe or device is in its place", str(self._own))
        with _lock(self.folder, self._shard):
            try:
                self._read()
                # Appending a line is atomic enough and fast; rewriting the file for each model
                # would take quadratic time.
                if not self._shard and self._count > _TIDY * len(self._lines):
                    self.tidy()
                self._log = self._own.open("ab")
                if self._log.tell() and not _ends_a_line(self._own):
                    self._log.write(b"\n")  # an earlier run was cut off
                self._recover()
                yield self
            finally:
                self.close()

    def close(self) -> None:
        """Close the files."""
        for file in (*self._files, self._log, self._journal):
            if file is not None:
                file.close()
        self._files, self._log, self._journal = [], None, None

    def __len__(self) -> int:
        return len(self._lines)

    def get(self, source: str) -> ModelRecord | None:
        """Return the last record of a model; None if there is none."""
        line = self._lines.get(source)
        if line is None:
            return None
        file = self._files[line.file]
        file.seek(line.offset)
        return parse_record(file.readline())

    def require_in_place(self) -> None:
        """Raise if the folder of the results is no longer the one that the manifest was opened in.

        Raises:
            FileNotFoundError: it was removed, renamed or unmounted, and what is written would be somewhere else.
        """
        if self._log is None or not is_open_at(self._log.fileno(), self._own):
            raise FileNotFoundError(errno.ENOENT, "it was removed, renamed or unmounted", str(self.folder.parent))

    def announce(self, source: str, results: tuple[Dependency, ...]) -> None:
        """Note which results are about to be written: a run that is killed now leaves them without a record.

        Raises:
            OSError: it cannot be written.
        """
        if self._journal is None:
            raise ValueError("the manifest is not open")
        # If the model has an error by the next run, nobody would know otherwise that these files
        # are ours to remove.
        self._journal.write(record_line(_record_files(source, results)))
        self._journal.flush()

    def _recover(self) -> None:
        """Add the results that a killed run was writing to the record of their model, which is worked on again."""
        path = self._own.with_name(self._own.name.replace("manifest", "journal", 1))
        self._journal = path.open("a+b")
        self._journal.seek(0)
        announced = parse_record(self._journal.readline())
        if announced is None:
            return
        known = self.get(announced.source)
        standing = (known and known.standing) or _record_files(announced.source, ())
        have = {(each.path, each.digest) for each in standing.results}
        new = tuple(each for each in announced.results if (each.path, each.digest) not in have)
        if new:
            kept = replace(standing, request="", results=(*standing.results, *new))
            self.add(replace(_record_files(announced.source, ()), outcome=Outcome.UNWRITTEN, kept=kept))
            self._read()

    def add(self, record: ModelRecord) -> None:
        """Write a record to disk at once.

        Raises:
            OSError: it cannot be written.
        """
        if self._log is None:
            raise ValueError("the manifest is not open")
        self._log.write(record_line(record))
        self._log.flush()
        if self._journal is not None and self._journal.tell():
            # The record is on the disk, so the announcement has done its work.
            self._journal.truncate(0)
            self._journal.seek(0)

    def _read(self) -> None:
        """Find the last line of each model, in the newest file that has one."""
        for file in self._files:
            file.close()
        self._files, self._lines, self._count = [], {}, 0
        files = [path for path in self.folder.glob("manifest*.jsonl") if path.is_file()]
        for path in sorted(files, key=lambda each: (each.stat().st_mtime_ns, each.name)):
            self._files.append(path.open("rb"))
            for offset, line in _lines(self._files[-1]):
                self._count += 1
                source = _read_source(line)
                if source is not None:
                    self._lines[source] = _ManifestLine(len(self._files) - 1, offset)

    def tidy(self) -> None:
        """Write the last record of each model, of all shards, into one file.

        Raises:
            OSError: it cannot be written; the files of all shards are there as before.
        """
        with transaction() as files:
            new = files.stage(self.folder)
            with named_after(self._own), new.open("wb") as file:
                file.writelines(record_line(record) for record in map(self.get, self._lines) if record)
            sync_files([(new, self._own)])
            self.close()
            with named_after(self._own):
                files.move(new, self._own)
            for path in self.folder.glob("manifest-*.jsonl"):
                files.take_away(path, self.folder)
            files.sync()
            files.done = True
        self._read()


_EMPTY = ModelRecord(source="", request="", outcome=Outcome.CONVERTED)


def _record_files(source: str, results: tuple[Dependency, ...]) -> ModelRecord:
    """Return a record of files that we wrote, which matches no request."""
    return ModelRecord(source=source, request="", outcome=Outcome.CONVERTED, results=results)


def record_line(record: ModelRecord) -> bytes:
    """Return a record as a line of JSON."""
    return json.dumps(_packed(record)).encode("ascii") + b"\n"


def _packed(record: ModelRecord) -> dict[str, Any]:
    whole: dict[str, Any] = {each.name: getattr(record, each.name) for each in fields(ModelRecord)}
    whole |= {name: packed(whole[name]) for name in _DEPENDENCIES}
    whole["kept"] = record.kept and _packed(record.kept)
    return {name: value for name, value in whole.items() if value or name in {"source", "request", "outcome"}}


def parse_record(line: bytes) -> ModelRecord | None:
    """Return the record in a line; None if the line is no record or was cut off."""
    try:
        record = _unpacked(json.loads(line))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None
    return record if _is_sound(record) and (record.kept is None or _is_sound(record.kept)) else None


def _unpacked(whole: dict[str, Any]) -> ModelRecord:
    for name in _DEPENDENCIES:
        whole[name] = tuple(unpacked(whole.get(name, ())))
    whole["outcome"] = Outcome(whole["outcome"])
    whole["kept"] = _unpacked(whole["kept"]) if "kept" in whole else None
    return ModelRecord(**whole)


def read_records(path: Path) -> Iterator[ModelRecord]:
    """Yield the records of a manifest in another folder.

    Raises:
        OSError: it cannot be read.
    """
    with path.open("rb") as file:
        yield from (record for _, line in _lines(file) if (record := parse_record(line)))


def _is_sound(record: ModelRecord) -> bool:
    """Return whether the fields of a record have their types."""
    names = (each.name for each in fields(ModelRecord) if each.name != "kept")
    return all(type(getattr(record, name)) is type(getattr(_EMPTY, name)) for name in names)


def _lines(file: BinaryIO) -> Iterator[tuple[int, bytes]]:
    offset = 0
    for line in file:
        yield offset, line
        offset += len(line)


def _read_source(line: bytes) -> str | None:
    """Return the name of the model in a line, without parsing all of it."""
    if not (line.startswith(_BEGIN) and line.endswith(b"}\n")):
        return None
    try:
        found: object = _DECODER.raw_decode(line[len(_BEGIN) :].decode("ascii"))[0]
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, str) else None


def _ends_a_line(path: Path) -> bool:
    with path.open("rb") as file:
        file.seek(-1, 2)
        return file.read(1) == b"\n"


@contextmanager
def _lock(folder: Path, shard: str = "") -> Generator[None]:
    """Lock a folder of results, or one shard of it; the system unlocks it when the process ends, however it ends.

    Raises:
        BusyError: another run has locked it.
        OSError: nothing can be written there.
    """
    with _hold(folder / "lock", shared=bool(shard)):
        if not shard:
            yield
            return
        with _hold(folder / f"lock-{shard}", shared=False):
            yield


@contextmanager
def _hold(path: Path, *, shared: bool) -> Generator[None]:
    path.parent.mkdir(parents=True, exist_ok=True)
    # nobody removes the file: another run could then hold one of the same name
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    try:
        try:
            if fcntl is not None:
                # A run of all models excludes every other, while shards share this lock and exclude
                # only themselves. A file with a process ID would have to be doubted after a crash.
                fcntl.flock(descriptor, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BusyError(f"another run is at work in {path.parent.parent}") from error
        yield
    finally:
        with suppress(OSError):
            os.close(descriptor)
