"""A cache of readings on disk, by the content of the file and the release of the reader."""

import hashlib
import json
import sqlite3
from contextlib import closing
from dataclasses import asdict
from functools import cache
from pathlib import Path

from testbed.engines.readers.answers import Kept
from testbed.engines.readers.library import Reader, Reading

_HERE = Path(__file__).parent
_SOURCES = ("answers.py", "child.py", "engines.py", "functions.py", "parsers.py", "urdf_load.cpp")
_ASKING = tuple(_HERE / name for name in _SOURCES)
_WAIT = 60
"""In s, for another process that writes."""


class Recalled:
    """Asks readers, and writes their readings into a database."""

    def __init__(self, database: Path) -> None:
        database.parent.mkdir(parents=True, exist_ok=True)
        self._database = database
        with closing(self._opened()) as connection, connection:
            connection.execute("CREATE TABLE IF NOT EXISTS readings (key TEXT PRIMARY KEY, reading TEXT)")

    def ask(self, reader: Reader, path: Path) -> Reading:
        """Its reading of a file, from the database where it is there."""
        key = _key(reader, path)
        with closing(self._opened()) as connection:
            row = connection.execute("SELECT reading FROM readings WHERE key = ?", (key,)).fetchone()
        if row is not None:
            return _reading(row[0])
        reading = reader.ask(path)
        with closing(self._opened()) as connection, connection:
            connection.execute("INSERT OR REPLACE INTO readings VALUES (?, ?)", (key, json.dumps(asdict(reading))))
        return reading

    def _opened(self) -> sqlite3.Connection:
        return sqlite3.connect(self._database, timeout=_WAIT)


def _key(reader: Reader, path: Path) -> str:
    parts = (reader.name.encode(), _release(reader), path.suffix.encode(), path.read_bytes())
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


@cache
def _release(reader: Reader) -> bytes:
    """Its version, and the sources that ask it: an answer to other questions is not remembered."""
    return b"\0".join((reader.version().encode(), *map(Path.read_bytes, _ASKING)))


def _reading(text: str) -> Reading:
    row = json.loads(text)
    kept = row["kept"] and Kept(
        tuple(row["kept"]["links"]), tuple(row["kept"]["joints"]), row["kept"]["masses"], row["kept"]["shapes"]
    )
    return Reading(row["error"], row["output"], kept)
