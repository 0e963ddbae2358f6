"""Finds a configuration and reads its file; the error of a wrong one."""

import os
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import cast

from twinform.cli.command import Unusable
from twinform.file_access import REPOSITORY, Readable, folders_above, has_any
from twinform.lazy import lazy_pattern

OWN = "twinform.toml"
_SHARED = "pyproject.toml"
_LARGEST = 2**20
_DEEPEST = 64
# A dotted key with too many parts: `tomllib` is quadratic in them, and 200,000 parts in a file of 400 kB took longer
# than a minute. No setting has more than three.
_DEEP_KEY = lazy_pattern(rb"""(?:\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*){%d}""" % _DEEPEST)
_LINE = lazy_pattern(r" \(at line (\d+), column \d+\)")
# A number with so many digits that `int` raises a plain ValueError, without a line.
_LONG_NUMBER = lazy_pattern(rb"[0-9_]{%d}" % sys.get_int_max_str_digits())
Table = Mapping[str, object]


class Searched:
    """Finds the nearest configuration of folders, and looks into each folder once."""

    def __init__(self) -> None:
        self._known: dict[Path, tuple[Path, Table] | ConfigError | None] = {}

    def find(self, start: Path) -> tuple[Path, Table] | None:
        """Find the nearest configuration in a folder and those above it; `twinform.toml` wins over `pyproject.toml`.

        The search ends at the top of the repository or at the home folder of the user.

        Raises:
            ConfigError: the configuration cannot be read.
        """
        passed: list[Path] = []
        found = None
        for folder in _project_folders(start):
            if folder in self._known:
                found = self._known[folder]
                break
            passed.append(folder)
            found = _configuration_in(folder)
            if found is not None:
                break
        self._known.update(dict.fromkeys(passed, found))
        if isinstance(found, ConfigError):
            raise found
        return found


def _configuration_in(folder: Path) -> "tuple[Path, Table] | ConfigError | None":
    """Return the configuration in a folder, or why it cannot be read."""
    for name in (OWN, _SHARED):
        path = folder / name
        try:
            found = _read_settings(path) if os.path.isfile(path) else None  # noqa: PTH113 - is_file raises for a long name
        except ConfigError as error:
            return error
        if found is not None:
            return path, found
    return None


def _project_folders(start: Path) -> Iterator[Path]:
    """Yield the folders of the project that a folder belongs to, and the home folder if the project is in it."""
    last = start
    for folder in (start, *folders_above(start)):
        yield (last := folder)
        if has_any(folder, REPOSITORY):
            return
    home = Path("~").expanduser()
    if os.path.realpath(last.parent) == os.path.realpath(home):
        yield home


def _read_settings(path: Path) -> Table | None:
    """Return the settings of a file, if it has any; mistakes in the settings of other tools do not count."""
    if path.name == _SHARED and b"twinform" not in _bytes(path):
        return None
    return section(path)


def section(path: Path) -> Table | None:
    """Read the settings of a file; None if it is a `pyproject.toml` without any.

    Raises:
        ConfigError: the file cannot be read.
    """
    found = _parse(path)
    if path.name == _SHARED:
        tool = _table(found.get("tool", {}), path, "tool")
        if "twinform" not in tool:
            return None
        found = _table(tool["twinform"], path, "tool.twinform")
    if any("\0" in text for text in _texts(found)):
        raise ConfigError(path, "a text in it has a zero character, which no name and no value can have")
    return found


def _texts(value: object) -> Iterator[str]:
    """Yield all texts in a value, keys of tables too."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, each in cast("Table", value).items():
            yield key
            yield from _texts(each)
    elif isinstance(value, list):
        for each in cast("list[object]", value):
            yield from _texts(each)


def _table(value: object, path: Path, key: str) -> Table:
    if not isinstance(value, dict):
        raise ConfigError(path, f"{key} has to be a table")
    return cast("Table", value)


def _parse(path: Path) -> Table:
    import tomllib  # noqa: PLC0415 - most folders have no configuration

    data = _bytes(path)
    if deep := _DEEP_KEY.search(data):
        line = data.count(b"\n", 0, deep.start()) + 1
        raise ConfigError(path, f"a key has more than {_DEEPEST} parts", line=line)
    try:
        return tomllib.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ConfigError(path, "the file is not UTF-8", line=line) from error
    except tomllib.TOMLDecodeError as error:
        at = _LINE.search(str(error))
        raise ConfigError(path, _LINE.sub("", str(error)), line=int(at[1]) if at else None) from error
    except RecursionError as error:
        raise ConfigError(path, "it is nested too deeply") from error
    except ValueError as error:  # raised by `int`, without a place
        line = next((at for at, text in enumerate(data.split(b"\n"), 1) if _LONG_NUMBER.search(text)), None)
        raise ConfigError(path, f"a number has more than {sys.get_int_max_str_digits():,} digits", line=line) from error


def _bytes(path: Path) -> bytes:
    try:
        data = Readable.of(path).read(path, _LARGEST)
    except OSError as error:
        raise ConfigError(path, f"cannot be read: {error.strerror}") from error
    if len(data) > _LARGEST:
        raise ConfigError(path, f"is larger than {_LARGEST} bytes")
    return data


def line_of(path: Path, key: str) -> int:
    """Return the line on which a key stands in a configuration; the first one where it is not found."""
    try:
        text = _bytes(path).decode("utf-8-sig", "replace")
    except ConfigError:
        return 1
    place = _IN_TABLE.match(key)
    headers = [found.end() for found in _FILES.finditer(text)] if place else []
    start = headers[int(place["number"])] if place and int(place["number"]) < len(headers) else 0
    name = re.escape(key.rpartition(".")[2].partition("[")[0].strip('"'))
    found = re.compile(rf"""^[ \t]*(?:\[++[^\]\n]*?)?["']?{name}["']?[ \t]*[=\]]""", re.MULTILINE).search(text, start)
    return text.count("\n", 0, found.start() if found else start) + 1


_IN_TABLE = lazy_pattern(r"(?:tool\.twinform\.)?files\[(?P<number>\d{1,4})\]")
_FILES = lazy_pattern(r"^[ \t]*\[\[[ \t]*(?:tool\.twinform\.)?files[ \t]*\]\]", re.MULTILINE)
_SECTION = "tool.twinform"


class ConfigError(Unusable):
    """A configuration is wrong; the message names the file, the line if it is known, and the key."""

    def __init__(self, file: Path, problem: str, *, key: str = "", line: int | None = None) -> None:
        key = f"{_SECTION}{'.' if key else ''}{key}" if file.name == "pyproject.toml" and line is None else key
        where = f"{file}:{line}" if line is not None else str(file)
        super().__init__(": ".join(part for part in (where, key, problem) if part))
        self.file, self.problem, self.key, self.line = file, problem, key, line
