"""Results of earlier runs, and what each depends on: a result counts as long as making it again would read the same.

A file has the results of the runs in one folder. It is JSON, so whatever it says runs nothing, and it begins with a
digest of the rest. What cannot be read, or is not as it was written, is as if it were not there.
"""

import os
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from twinform.compiler.dependencies import (
    Dependency,
    are_current,
    dependencies_of,
    has_other_variables,
    packed,
    renewed,
    status,
    unpacked,
)
from twinform.compiler.observing import Observation, digest, observed
from twinform.file_access import read_regular
from twinform.lazy import lazy_pattern
from twinform.storage.user_cache import prune
from twinform.storage.writing import write_atomically

Item = TypeVar("Item")
_FORMAT = 1
"""Is raised when what is written changes although the version of twinform does not."""
_LARGEST_RESULT = 2**20
"""Characters of a result that is kept."""
_LARGEST_FILE = 2**25
_LARGEST = 2**28
"""Bytes of one file, and of all; beyond them, what was used longest ago is deleted."""
_MALFORMED = (AttributeError, LookupError, RecursionError, TypeError, ValueError)
_PER_DEPENDENCY = 150
"""Bytes of a dependency in a file, more or less."""


_NAME = lazy_pattern(r"[0-9a-f]{64}\.json")


def delete_results(folder: Path) -> int:
    """Delete all files of results in a folder, and in those that it has in a repository; return their number.

    Raises:
        OSError: one cannot be deleted.
    """
    found = [path for path in (*folder.glob("*"), *folder.glob("*/*")) if _NAME.fullmatch(path.name)]
    for path in found:
        path.unlink(missing_ok=True)
    return len(found)


class Group(NamedTuple):
    """Dependencies that several results may share, and a time before any of them was looked at."""

    time: int
    dependencies: tuple[Dependency, ...]


class Observed(NamedTuple):
    """What a result depends on: groups of dependencies, and the environment variables that were read."""

    groups: tuple[Group, ...]
    variables: dict[str, str | None]


class Observer:
    """Observes work, and returns what its results depend on."""

    def __init__(self) -> None:
        self._begin = time.time_ns()
        self._known: dict[int, tuple[Observation, Group | None]] = {}

    def observe(self, work: Callable[[], Item]) -> tuple[Item, Observed | None]:
        """Do the work; return its result, and what it depends on unless it has to be done again each time."""
        with observed() as seen:
            made = work()
        groups: list[Group] = []
        variables: dict[str, str | None] = {}
        for part in seen.walk():
            group = self._group_of(part, is_shared=part is not seen)
            if group is None:
                return made, None
            groups.append(group)
            variables |= part.variables
        return made, Observed(tuple(groups), variables)

    def _group_of(self, part: Observation, *, is_shared: bool) -> Group | None:
        if id(part) in self._known:
            return self._known[id(part)][1]
        found = dependencies_of(part, os.sep, outside=None, names=True)
        group = None if found is None else Group(self._begin, found)
        if is_shared:  # it is kept with the part, whose number would else be that of another one
            self._known[id(part)] = (part, group)
        return group


class _Numbered(Generic[Item]):
    """Items by their numbers, each once."""

    def __init__(self, items: Iterable[Item] = ()) -> None:
        self.items = list(items)
        self._numbers = {item: number for number, item in enumerate(self.items)}

    def number(self, item: Item) -> int:
        """Return the number of an item, which is added if it is new."""
        number = self._numbers.setdefault(item, len(self.items))
        if number == len(self.items):
            self.items.append(item)
        return number


def _version_of(file: Path) -> tuple[int, int] | None:
    """Return what is another thing once a file was replaced; None where there is none."""
    found = status(str(file))
    return None if found is None else (found.st_ino, found.st_mtime_ns)


def _require_below(most: int, lists: Iterable[list[int]]) -> None:
    """Require that all numbers are those of something that is there.

    Raises:
        ValueError: one is not.
    """
    if not all(0 <= number < most for numbers in lists for number in numbers):
        raise ValueError(most)


class _KeptGroup(NamedTuple):
    time: int
    dependencies: tuple[int, ...]


class _KeptResult(NamedTuple):
    """A result in the JSON that it is written in, and the numbers of its groups."""

    groups: tuple[int, ...]
    variables: dict[str, str | None]
    text: str


class ResultCache:
    """The results in one file; without a file nothing is kept.

    Files of one folder depend on much the same, so each dependency and each group of them is written and checked once.
    """

    def __init__(self, file: Path | None) -> None:
        self.observer = Observer()
        self._file = file
        self._begin = time.time_ns()
        self._dependencies = _Numbered[Dependency]()
        self._groups = _Numbered[_KeptGroup]()
        self._results: dict[str, _KeptResult] = {}
        self._used: dict[str, None] = {}
        self._is_changed = False
        # what is asked of the disk is asked once for all results
        self._status = cache(status)
        self._is_current = cache(self._compare_status)
        self._renewed = cache(self._renew_group)
        self._before = _version_of(file) if file else None
        if file is not None:
            self._read(file)

    @classmethod
    def of(cls, folder: Path | None, *names: str) -> "ResultCache":
        """Return the results in a folder that have some names in common."""
        import json  # noqa: PLC0415 - only runs with kept results

        return cls(folder and folder / f"{digest(json.dumps([_FORMAT, *names]).encode())}.json")

    def get(self, key: str, parse: Callable[[Any], Item]) -> Item | None:
        """Return a result as `parse` reads it; None where there is none that still counts."""
        import json  # noqa: PLC0415 - only runs with kept results

        kept = self._results.get(key)
        if kept is None or has_other_variables(kept.variables):
            return None
        with suppress(*_MALFORMED):
            groups = tuple(map(self._renewed, kept.groups))
            if None not in groups:
                self._is_changed |= groups != kept.groups
                self._results[key] = kept._replace(groups=tuple(each for each in groups if each is not None))
                self._used[key] = None
                return parse(json.loads(kept.text))
        return None

    def put(self, key: str, result: object, seen: Observed) -> None:
        """Keep a result."""
        import json  # noqa: PLC0415 - only runs with kept results

        text = json.dumps(result)
        if self._file is not None and len(text) <= _LARGEST_RESULT:
            self._results[key] = _KeptResult(tuple(map(self._number, seen.groups)), seen.variables, text)
            self._used[key] = None
            self._is_changed = True

    def save(self) -> None:
        """Write the file if anything has changed; a folder that cannot be written to is no reason to fail."""
        import json  # noqa: PLC0415 - only runs with kept results

        if self._file is None or not self._is_changed:
            return
        if _version_of(self._file) != self._before:  # another run has written it meanwhile
            self._take_over(ResultCache(self._file))
        data = json.dumps(self._to_json()).encode()
        with suppress(OSError):
            write_atomically(self._file, digest(data).encode() + b"\n" + data, durably=False)
            prune(self._file.parent, _LARGEST)

    def _number(self, group: Group) -> int:
        return self._groups.number(_KeptGroup(group.time, tuple(map(self._dependencies.number, group.dependencies))))

    def _renew_group(self, number: int) -> int | None:
        """Return the number of a group if it is current, or of the same with the status of its files now; else None."""
        group = self._groups.items[number]
        if all(self._is_current(each, group.time) for each in group.dependencies):
            return number
        same = renewed((self._dependencies.items[each] for each in group.dependencies), os.sep)
        return None if same is None else self._number(Group(self._begin, same))

    def _compare_status(self, number: int, noted: int) -> bool:
        return are_current((self._dependencies.items[number],), os.sep, noted=noted, status=self._status)

    def _read(self, file: Path) -> None:
        import json  # noqa: PLC0415 - only runs with kept results

        with suppress(OSError, *_MALFORMED):
            mark, _, data = read_regular(file, _LARGEST_FILE).partition(b"\n")
            if digest(data).encode() != mark:
                return
            dependencies, groups, results = json.loads(data)
            _require_below(len(dependencies), (numbers for _, numbers in groups))
            _require_below(len(groups), (numbers for numbers, _, _ in results.values()))
            self._dependencies = _Numbered(unpacked(dependencies))
            self._groups = _Numbered(_KeptGroup(noted, tuple(numbers)) for noted, numbers in groups)
            self._results = {key: _KeptResult(tuple(ids), given, text) for key, (ids, given, text) in results.items()}

    def _take_over(self, other: "ResultCache") -> None:
        """Add the results of another run for which there is none here."""
        for key, seen, text in other.observed_results():
            if key not in self._results:
                self._results[key] = _KeptResult(tuple(map(self._number, seen.groups)), seen.variables, text)

    def observed_results(self) -> Iterator[tuple[str, Observed, str]]:
        """Yield the key of each result, what it depends on, and its text."""
        for key, kept in self._results.items():
            kept_groups = (self._groups.items[number] for number in kept.groups)
            groups = tuple(Group(each.time, self._dependencies_of(each)) for each in kept_groups)
            yield key, Observed(groups, kept.variables), kept.text

    def _dependencies_of(self, group: _KeptGroup) -> tuple[Dependency, ...]:
        return tuple(self._dependencies.items[number] for number in group.dependencies)

    def _to_json(self) -> list[Any]:
        """Return what is written: the results that were used last, as many as there is room for."""
        order = [*self._used, *(key for key in reversed(self._results) if key not in self._used)]
        dependencies, groups, left = _Numbered[Dependency](), _Numbered[tuple[int, tuple[int, ...]]](), _LARGEST_FILE
        results: dict[str, list[object]] = {}
        for key in order:
            kept, before = self._results[key], len(dependencies.items)
            numbers: list[int] = []
            for group in (self._groups.items[number] for number in kept.groups):
                inside = tuple(map(dependencies.number, self._dependencies_of(group)))
                numbers.append(groups.number((group.time, inside)))
            left -= len(kept.text) * 2 + (len(dependencies.items) - before) * _PER_DEPENDENCY
            if left < 0:
                break
            results[key] = [numbers, kept.variables, kept.text]
        return [packed(dependencies.items), groups.items, dict(reversed(results.items()))]
