"""The manifest of earlier runs: a line of JSON for each converted model, of which the last one counts."""

import errno
import hashlib
import json
from dataclasses import asdict
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from twinform.compiler.batch.record import Record
from twinform.compiler.input.regular_files import read_regular
from twinform.compiler.output.files import write_atomically
from twinform.compiler.output.same_files import is_stream

_FOLDER = ".twinform-batch"
_FILE = "manifest.jsonl"
_RECORD = TypeAdapter(Record)


def digest(content: bytes) -> str:
    """What tells contents apart."""
    return hashlib.sha256(content).hexdigest()


def is_unchanged(path: Path, made: str) -> bool:
    """Whether a file is as it was written, by the digest of that."""
    try:
        return digest(read_regular(path)) == made
    except OSError:
        return False


class Manifest:
    """The records in the folder of the results. A run that is stopped loses nothing that was done."""

    def __init__(self, dest: Path) -> None:
        self.folder = dest / _FOLDER
        self._path = self.folder / _FILE
        self.records = _read(self._path)

    def add(self, record: Record) -> None:
        """Keep a record, at once and for later runs.

        Raises:
            OSError: it cannot be written.
        """
        self.records[record.source] = record
        with self._path.open("a", encoding="ascii", newline="\n") as file:
            file.write(_line(record))

    def begin(self) -> None:
        """Make the folder, and write the file anew with one line for each model.

        Raises:
            OSError: it cannot be written.
        """
        if is_stream(self._path):
            raise FileExistsError(errno.EEXIST, "a pipe or device is in its place", str(self._path))
        write_atomically(self._path, "".join(map(_line, self.records.values())))


def _line(record: Record) -> str:
    return json.dumps(asdict(record)) + "\n"


def _read(path: Path) -> dict[str, Record]:
    """The records of a file; lines that are none, such as one that was cut off, are left out."""
    try:
        lines = read_regular(path).splitlines()
    except OSError:
        return {}
    found = (_record(line) for line in lines)
    return {record.source: record for record in found if record}


def _record(line: bytes) -> Record | None:
    try:
        return _RECORD.validate_python(json.loads(line))
    except (ValueError, ValidationError, RecursionError):
        return None
