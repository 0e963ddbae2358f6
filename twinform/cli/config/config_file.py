"""Finding a configuration, and reading its file."""

import os
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import cast

from twinform.cli.config.config_error import ConfigError
from twinform.file_access import REPOSITORY, Readable, folders_above, has_any

OWN = "twinform.toml"
_SHARED = "pyproject.toml"
_LARGEST = 2**20
_DEEPEST = 64
# A dotted key with too many parts.
# `tomllib` walks through all parts of a dotted key for each of them: 200,000 parts in a file of 400
# kB took longer than a minute. No setting has more than three.
_DEEP_KEY = re.compile(rb"""(?:\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*){%d}""" % _DEEPEST)
_LINE = re.compile(r" \(at line (\d+), column \d+\)")
# `int` raises a plain ValueError for so many digits, without a line.
_LONG_NUMBER = re.compile(rb"[0-9_]{%d}" % sys.get_int_max_str_digits())
Table = Mapping[str, object]


def find(start: Path) -> tuple[Path, Table] | None:
    """The nearest configuration in a folder and those above it; `twinform.toml` goes before `pyproject.toml`.

    What lies above the top of the repository, or above the home folder of the user, is not looked at.

    Raises:
        ConfigError: there is one, and it cannot be read.
    """
    for folder in _project(start):
        for name in (OWN, _SHARED):
            path = folder / name
            found = _look(path) if path.is_file() else None
            if found is not None:
                return path, found
    return None


def _project(start: Path) -> Iterator[Path]:
    """The folders of the project that a folder belongs to, and the home folder where they lie in it."""
    last = start
    for folder in (start, *folders_above(start)):
        yield (last := folder)
        if has_any(folder, REPOSITORY):
            return
    home = Path("~").expanduser()
    if os.path.realpath(last.parent) == os.path.realpath(home):
        yield home


def _look(path: Path) -> Table | None:
    """The settings of a file on the way up, if it has any for twinform; other tools' faults do not count."""
    if path.name == _SHARED and b"twinform" not in _bytes(path):
        return None
    return section(path)


def section(path: Path) -> Table | None:
    """Our part of a file; None where a `pyproject.toml` has none.

    Raises:
        ConfigError: the file cannot be read.
    """
    found = _parsed(path)
    if path.name == _SHARED:
        tool = _table(found.get("tool", {}), path, "tool")
        if "twinform" not in tool:
            return None
        found = _table(tool["twinform"], path, "tool.twinform")
    if any("\0" in text for text in _texts(found)):
        raise ConfigError(path, "a text in it has a zero character, which no name and no value can have")
    return found


def _texts(value: object) -> Iterator[str]:
    """All texts in a value, keys of tables among them."""
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


def _parsed(path: Path) -> Table:
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
    except ValueError as error:  # of `int`, which does not say where
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
