"""Output paths of a batch, and which of them are taken by a model, another result, or a device."""

import os
from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path, PurePosixPath

from twinform.compiler.batch.entries import FolderError, ModelEntry, stem
from twinform.storage.writing import identities, is_stream

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
