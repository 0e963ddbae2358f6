"""What every worker of a batch must have in common with the command: the same compiler, and the same files.

A worker of another version makes other results, and one that does not see the files, or sees an older copy, says of
good models that they cannot be read. So a run asks before its first model, and ends if one does not fit.
"""

import hashlib
import json
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from twinform.compiler.batch.entries import ModelEntry
from twinform.compiler.observing import digest
from twinform.compiler.workers import Runner
from twinform.file_access import read_regular

# Versions of Python and lxml may differ between machines: they change the wording of some messages
# and no result that we know of.
READERS = ("collada", "pycollada", "scipy", "trimesh", "xacro")
"""Packages that need not be there, and that what comes of a model depends on."""
_SAMPLE = 16
"""Models that a worker and the command both look at."""
_LARGEST = 2**26
_ADVICE = "where workers run in another folder, give paths from the root"


class UnfitWorkerError(Exception):
    """A worker has another compiler or other files; the message names the machine and what differs."""


@dataclass(frozen=True, slots=True)
class Worksite:
    """The versions that decide what comes of a model, and what is at some paths: digests, None where nothing is."""

    versions: Mapping[str, str]
    contents: Mapping[str, str | None]


@cache
def own_version() -> str:
    """The version of the compiler that works here."""
    return version("twinform")


def versions() -> dict[str, str]:
    """The version of the compiler, of its code, and of the packages that it reads with."""
    return {"twinform": own_version(), "the code of twinform": _code(), **{each: _version(each) for each in READERS}}


@cache
def fingerprint() -> str:
    """The digest of these versions."""
    return digest(json.dumps(versions()).encode())


def worksite(paths: Sequence[str]) -> Worksite:
    """What there is here of the compiler and at some paths."""
    return Worksite(versions(), {path: _content(Path(path)) for path in paths})


def checked(runner: Runner, root: Path, entries: Sequence[ModelEntry], folders: Iterable[Path]) -> Runner:
    """A runner that asks every worker for its worksite before the first job, if its workers are on other machines.

    They must see some of the models below `root`, all over the list, and the `folders` that are searched. The executor
    cannot be opened where one differs: that raises `UnfitWorkerError`.
    """
    if runner.everywhere is None:
        return runner
    sample = entries[:: max(1, len(entries) // _SAMPLE)][:_SAMPLE]
    paths = (root, *folders, *(root / entry.path for entry in sample))
    return replace(runner, open=partial(_opened, runner, list(map(str, paths))))


@contextmanager
def _opened(runner: Runner, paths: Sequence[str]) -> Generator[Executor]:
    with runner.open() as executor:
        if runner.everywhere is not None:
            ask = partial(runner.everywhere, executor)
            # in this order: a worker of another version may not know the second function, or send something else
            _require_version(ask)
            _require_same(ask(worksite, (paths,)), worksite(paths))
        yield executor


def _require_version(ask: Callable[[Callable[..., object], tuple[object, ...]], Mapping[str, object]]) -> None:
    # A function of Python itself, which a worker of any version knows.
    for machine, found in ask(version, ("twinform",)).items():
        if isinstance(found, PackageNotFoundError):
            raise UnfitWorkerError(f"{machine} has no twinform")
        if found != own_version():
            raise UnfitWorkerError(f"{machine} has twinform {found}, and here it is {own_version()}")


def _require_same(found: Mapping[str, object], own: Worksite) -> None:
    for machine, other in found.items():
        if not isinstance(other, Worksite):
            raise UnfitWorkerError(f"{machine} does not know what is asked of it: {other}")
        for name, wanted in own.versions.items():
            if other.versions.get(name) != wanted:
                raise UnfitWorkerError(f"{machine} has {_difference(name, other.versions.get(name, ''), wanted)}")
        for path, wanted in own.contents.items():
            if (seen := other.contents.get(path)) != wanted:
                advice = "" if Path(path).is_absolute() else f"; {_ADVICE}"
                raise UnfitWorkerError(f"{machine} {'has another' if seen else 'does not see'} {path}{advice}")


def _difference(name: str, found: str, wanted: str) -> str:
    if name.startswith("the code"):
        return f"twinform {own_version()} with other code than here"
    return f"{name} {found or 'not at all'}, and here it is {wanted or 'not there'}"


def _content(path: Path) -> str | None:
    try:
        return "a folder" if path.is_dir() else digest(read_regular(path, _LARGEST))
    except (OSError, ValueError):
        return None


@cache
def _code() -> str:
    """The digest of the package itself: an installation that is edited in place keeps its version."""
    top = Path(__file__).parents[2]
    whole = hashlib.sha256()
    for path in sorted(top.rglob("*.py")):
        whole.update(f"{path.relative_to(top).as_posix()}\0".encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""
