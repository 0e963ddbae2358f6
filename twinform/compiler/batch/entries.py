"""The models of a batch, from a folder, a list of names or a table; its shards; and the paths of its results."""

import csv
import hashlib
import json
import os
from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path, PurePosixPath
from posixpath import normpath
from typing import Any, cast

from twinform.compiler.input.include_graph import is_mjcf_model
from twinform.compiler.input.root_names import without_endings
from twinform.dataclass import dataclass
from twinform.file_access import Readable
from twinform.storage.writing import identities, is_stream

PATTERNS = ("*.urdf", "*.sdf", "*.world", "*.mjcf", "*.urdf.xacro", "*.sdf.xacro", "*.world.xacro")
"""Files that are models by their names, beside MJCF called `.xml`; other xacro files are mostly parts of models."""
_MODEL, _NAME = "model", "name"
"""Columns of a table: the file, and what the model is called if that is not its path."""


class FolderError(ValueError):
    """The folders or names that were given do not make a batch."""


@dataclass(frozen=True, slots=True)
class ModelEntry:
    """A model: its name, which is also its path among the results, and its path below the folder of the models.

    `arguments` are for xacro. `other` is the path of the model that it is compared with, in another folder.
    """

    name: str
    path: str
    arguments: tuple[tuple[str, str], ...] = ()
    other: str = ""


@dataclass(frozen=True, slots=True)
class Shard:
    """One of several runs that share the work on a batch."""

    number: int
    count: int

    @property
    def label(self) -> str:
        """The part of its file names that names the shard."""
        return f"{self.number}-of-{self.count}"

    def has(self, entry: ModelEntry) -> bool:
        """Return whether a model is in this shard, which depends on its name alone."""
        # Not `hash`, which differs from process to process.
        place = int.from_bytes(hashlib.sha256(os.fsencode(entry.name)).digest()[:8], "big")
        return place % self.count == self.number - 1


def of_folder(source: Path, patterns: Sequence[str] = PATTERNS, results: Path | None = None) -> list[ModelEntry]:
    """Return the models below a folder, sorted, without those in hidden folders and among the results.

    Raises:
        FolderError: there is no such folder.
    """
    if not source.is_dir():
        raise FolderError(f"{source} is no folder")
    left_out = results.resolve() if results else None
    found: list[str] = []
    for place, folders, files in os.walk(source):
        here = Path(place)
        # In place, as os.walk asks for: it descends into what is left in this list.
        folders[:] = [name for name in folders if not name.startswith(".") and (here / name).resolve() != left_out]
        inside = PurePosixPath(here.relative_to(source).as_posix())
        found += [str(inside / name) for name in files if any((inside / name).match(each) for each in patterns)]
        if tuple(patterns) == PATTERNS:
            found += [
                str(inside / name) for name in files if name.lower().endswith(".xml") and is_mjcf_model(here / name)
            ]
    return [ModelEntry(name, name) for name in sorted(found)]


def of_names(source: Path, text: bytes) -> list[ModelEntry]:
    """Return the models in a list of names, one in a line, or separated by zero bytes if there are any; each once.

    Raises:
        FolderError: one is not in the folder.
    """
    # As `find -print0` and `git ls-files -z` write them: a name may contain a line break.
    names = text.split(b"\0") if b"\0" in text else text.splitlines()
    paths = {_relative_path(source, os.fsdecode(name)) for name in names if name.strip()}
    return [ModelEntry(name, name) for name in sorted(paths)]


def with_arguments(entries: Iterable[ModelEntry], table: Path) -> list[ModelEntry]:
    """Return the models with arguments from a CSV or JSONL table; a model with several rows becomes several models.

    Raises:
        FolderError: the table has no such form, names a model that is not there, or gives two of them one name.
        OSError: it cannot be read.
    """
    known = {entry.name: entry for entry in entries}
    named: set[str] = set()
    made: dict[str, ModelEntry] = {}
    for where, row in _read_rows(table):
        path = normpath(row.pop(_MODEL, ""))
        name = normpath(row.pop(_NAME, "") or path)
        if path not in known:
            raise FolderError(f"{where}: no model is called {path!r}")
        if name in made or (name in known and name != path) or not _is_relative(name):
            raise FolderError(f"{where}: the name {name!r} is taken or no path; give another in the column {_NAME!r}")
        named.add(path)
        made[name] = replace(known[path], name=name, arguments=tuple(sorted(row.items())))
    rest = {name: entry for name, entry in known.items() if name not in named}
    return [entry for _, entry in sorted({**rest, **made}.items())]


def pairs(a: Iterable[ModelEntry], b: Iterable[ModelEntry]) -> list[ModelEntry]:
    """Pair the models of two folders that have the same name, with or without the endings of formats."""
    ours, theirs = _index_by_stem(a), _index_by_stem(b)
    for name in [name for name in theirs if name not in ours and name.rpartition(".")[0] in ours]:
        theirs.setdefault(
            name.rpartition(".")[0], theirs.pop(name)
        )  # where two had one name, results keep both endings
    return [ModelEntry(name, ours.get(name, ""), other=theirs.get(name, "")) for name in sorted({*ours, *theirs})]


def stem(name: str) -> str:
    """Return a name without the endings of formats."""
    return str(without_endings(PurePosixPath(name)))


def _index_by_stem(entries: Iterable[ModelEntry]) -> dict[str, str]:
    """Return paths by their names without endings; of two with the same name, both keep their endings."""
    found: dict[str, list[str]] = {}
    for entry in entries:
        found.setdefault(stem(entry.name), []).append(entry.path)
    alone = {name: paths[0] for name, paths in found.items() if len(paths) == 1}
    return alone | {path: path for paths in found.values() if len(paths) > 1 for path in paths}


def _relative_path(source: Path, name: str) -> str:
    """Return a name as a path below a folder."""
    path = normpath(os.path.relpath(name, source) if os.path.isabs(name) else name)  # noqa: PTH117 - no Path for bytes
    if not _is_relative(path):
        raise FolderError(f"{name!r} is not in the folder {source}")
    return path


def _is_relative(path: str) -> bool:
    return path not in {"", "."} and not path.startswith(("/", "../")) and path != ".."


def _read_rows(table: Path) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield the rows of a table with file and line, without empty cells."""
    try:
        # Excel begins a CSV file with a byte order mark, which would be part of the first column's
        # name.
        text = Readable.of(table).read(table).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FolderError(f"{table} is not in UTF-8") from error
    rows = _read_csv(text) if table.suffix.lower() == ".csv" else _read_jsonl(text, table)
    for number, row in rows:
        if not row.get(_MODEL):
            raise FolderError(f"{table}:{number}: there is nothing in the column {_MODEL!r}")
        yield f"{table}:{number}", {name: value for name, value in row.items() if value}


def _read_csv(text: str) -> Iterator[tuple[int, Mapping[str, str]]]:
    reader = csv.DictReader(text.splitlines())
    for row in reader:
        cells = cast("Mapping[Any, Any]", row)
        yield reader.line_num, {str(key): value for key, value in cells.items() if isinstance(value, str) and key}


def _read_jsonl(text: str, table: Path) -> Iterator[tuple[int, Mapping[str, str]]]:
    for number, line in enumerate(text.splitlines(), start=1):
        try:
            row: object = json.loads(line) if line.strip() else None
        except (ValueError, RecursionError) as error:
            raise FolderError(f"{table}:{number}: this is no JSON object") from error
        if isinstance(row, dict):
            cells = cast("Mapping[str, Any]", row)
            yield number, {key: value if isinstance(value, str) else json.dumps(value) for key, value in cells.items()}
        elif row is not None:
            raise FolderError(f"{table}:{number}: this is no JSON object")


LEDGER = ".ledger.json"
"""What is added to the name of a result for its ledger."""


def require_apart(source: Path, dest: Path) -> None:
    """Raise if results would become sources of the next run, or be written over sources.

    Raises:
        FolderError: the target is a file, or is the source or above it.
    """
    if dest.exists() and not dest.is_dir():
        raise FolderError(f"{dest} is no folder")
    if source.resolve().is_relative_to(dest.resolve()):
        raise FolderError(f"{dest} is {source} or has it inside; the results need a folder of their own")


def outputs(names: Iterable[str], to: str) -> Mapping[str, str]:
    """Return the path of each result: the name of the model with the new ending; a world in SDF keeps `.world`.

    If two results would have the same path, as of `a.urdf` and `a.sdf`, both keep their old endings before the new one.
    """
    plain = {name: f"{stem(name)}.{_choose_ending(name, to)}" for name in names}
    taken = Counter(map(str.casefold, plain.values()))  # paths that some file systems take for one are one
    return {name: path if taken[path.casefold()] == 1 else f"{name}.{to}" for name, path in plain.items()}


def _choose_ending(name: str, to: str) -> str:
    if to == "mjcf":
        return "xml"
    return "world" if to == "sdf" and ".world" in map(str.lower, PurePosixPath(name).suffixes) else to


class ResultPlaces:
    """The places of the results of one run, by the names of the models.

    If the folder of the results has no symbolic links, and a file has no second name, its path is its identity. So a
    million paths are only resolved where there is a reason.
    """

    def __init__(self, source: Path, dest: Path, entries: Sequence[ModelEntry], outputs: Mapping[str, str]) -> None:
        self._source, self.dest, self._entries, self.outputs = source, dest, entries, outputs
        self._written: set[Hashable] = set()

    def require_free(self, report: Path) -> None:
        """Raise if a report would be written over a model or a result.

        Raises:
            FolderError: it would.
        """
        over = next((self._models[each] for each in identities(report) if each in self._models), None)
        if over is None and self._results[os.path.realpath(report)]:
            over = "one of the results"
        if over is not None:
            raise FolderError(f"the report {report} would be written over {over}")

    def problem(self, name: str, paths: Iterable[str]) -> str | None:
        """Return why the results of a model, which are paths below the folder of all, must not be written."""
        own = {self.outputs[name], self.outputs[name] + LEDGER}
        problems = (self._problem(inside, is_own=inside in own) for inside in paths)
        return next(filter(None, problems), None)

    def take(self, paths: Iterable[str]) -> None:
        """Remember which files were written: another result may lead to one of them by another path."""
        if self._has_links:
            self._written.update(each for inside in paths for each in identities(self.dest / inside))

    def _problem(self, inside: str, *, is_own: bool) -> str | None:
        path = self.dest / inside
        if is_stream(path):
            return f"{path} is a pipe or device"
        if is_own and not self._has_links and _has_one_name(path):
            return None
        keys = set(identities(path))
        model = next((self._models[key] for key in keys if key in self._models), None)
        if model is not None:
            return f"{path} leads to the model {model}"
        if self._results[os.path.realpath(path)] > is_own or keys & self._written:
            return f"{path} leads to where another result goes"
        return None

    @cached_property
    def _has_links(self) -> bool:
        """Whether there is a symbolic link in the folder of the results."""
        for place, folders, files in os.walk(self.dest):
            if any(os.path.islink(os.path.join(place, name)) for name in (*folders, *files)):  # noqa: PTH114, PTH118 - many
                return True
        return False

    @cached_property
    def _models(self) -> Mapping[Hashable, str]:
        return {each: entry.name for entry in self._entries for each in identities(self._source / entry.path)}

    @cached_property
    def _results(self) -> Counter[str]:
        paths = (path for output in self.outputs.values() for path in (output, output + LEDGER))
        return Counter(os.path.realpath(self.dest / path) for path in paths)


def _has_one_name(path: Path) -> bool:
    """Return whether a file has no second name by a hard link."""
    try:
        return path.lstat().st_nlink == 1
    except OSError:
        return True
