"""What results depend on besides files: options, as JSON, and the installed code."""

import os
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import cast

from twinform.compiler.observing import digest
from twinform.passes import Pipeline, registered_passes

_PLAIN = bool | int | float | str
_NO_CODE = frozenset({"__pycache__"})
_OWN = str(Path(__file__).resolve().parents[1])
_INSTALLED = tuple(sysconfig.get_path(name) for name in ("purelib", "platlib"))


def describe_options(value: object) -> object:
    """Return a job or one of its options as JSON, so that results are redone when any of them changes."""
    if isinstance(value, Pipeline):
        return [str(value), sorted(f"{owner} {version(owner)}" for owner in owners_of(value))]
    if isinstance(value, frozenset):
        return sorted(map(str, cast("frozenset[object]", value)))
    if isinstance(value, tuple | list):
        return [describe_options(each) for each in cast("tuple[object, ...]", value)]
    if isinstance(value, Mapping):
        return [[str(key), describe_options(each)] for key, each in cast("Mapping[object, object]", value).items()]
    if is_dataclass(value):
        options = (describe_options(getattr(value, each.name)) for each in fields(value) if each.compare)
        return [type(value).__name__, *options]
    return value if value is None or isinstance(value, _PLAIN) else str(value)


def owners_of(passes: Pipeline) -> set[str]:
    """Return the packages that the passes of a pipeline come from."""
    known = registered_passes()
    return {owner for step in passes if step.name in known and (owner := known[step.name].owner)}


@cache
def installation() -> str:
    """Return a digest of what is installed: Python, every package with its version, and our code if it is edited."""
    packages = sorted(name for folder in sys.path for name in _packages_in(folder))
    own = sorted(_code_below(_OWN)) if not _OWN.startswith(_INSTALLED) else []
    return digest("\n".join([sys.version, version("twinform"), *packages, *own]).encode(errors="surrogateescape"))


def _packages_in(folder: str) -> list[str]:
    """Return the names of the folders that describe installed packages, which have their versions in them."""
    try:
        return [name for name in os.listdir(folder) if name.endswith((".dist-info", ".egg-info"))]  # noqa: PTH208 - many
    except OSError:  # an archive, or no longer there
        return []


def _code_below(folder: str) -> Iterator[str]:
    """Yield the status of every file of the package: one that is edited in place keeps its version."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if not entry.is_dir():
                status = entry.stat()
                yield f"{entry.path} {status.st_size} {status.st_mtime_ns} {status.st_ctime_ns} {status.st_ino}"
            elif entry.name not in _NO_CODE:
                yield from _code_below(entry.path)
