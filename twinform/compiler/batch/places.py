"""Output paths of a batch, and which of them are taken by a model, another result, or a device."""

import os
from collections import Counter
from collections.abc import Hashable, Iterator, Mapping
from pathlib import Path, PurePosixPath

from twinform.compiler.batch.files import FolderError
from twinform.compiler.output.same_files import identities, is_stream

LEDGER = ".ledger.json"
"""What the name of a result has more where it is that of its ledger."""


def texts_of(path: Path, text: str, ledger: str | None) -> dict[Path, str]:
    """A result and, if it is wanted, its ledger, in their places."""
    return {path: text} if ledger is None else {path: text, ledger_of(path): ledger}


def ledger_of(path: Path) -> Path:
    """The place of the ledger of a result."""
    return path.with_name(path.name + LEDGER)


class Places:
    """The places of the results of one run, by the names of the models."""

    def __init__(
        self, source: Path, dest: Path, outputs: Mapping[PurePosixPath, PurePosixPath], *, ledgers: bool
    ) -> None:
        self._dest, self._outputs, self._ledgers = dest, outputs, ledgers
        self._sources = {each: name for name in outputs for each in identities(source / name)}
        self._results = Counter(os.path.realpath(path) for name in outputs for path in self._of(name))
        self._written: set[Hashable] = set()

    def require_free(self, report: Path) -> None:
        """Raise where a report would be written over a model or a result.

        Raises:
            FolderError: it would.
        """
        over = next((str(self._sources[each]) for each in identities(report) if each in self._sources), None)
        if over is None and os.path.realpath(report) in self._results:
            over = "one of the results"
        if over is not None:
            raise FolderError(f"the report {report} would be written over {over}")

    def problem(self, name: PurePosixPath) -> str | None:
        """Why the result of a model must not be written."""
        for path in self._of(name):
            if is_stream(path):
                return f"{path} is a pipe or device"
            keys = set(identities(path))
            model = next((self._sources[key] for key in keys if key in self._sources), None)
            if model is not None:
                return f"{path} leads to the model {model}"
            if self._results[os.path.realpath(path)] > 1 or keys & self._written:
                return f"{path} leads to where another result goes"
        return None

    def take(self, name: PurePosixPath) -> None:
        """Remember that the result of a model is in its place: another may have that place without its path."""
        self._written.update(each for path in self._of(name) for each in identities(path))

    def _of(self, name: PurePosixPath) -> Iterator[Path]:
        path = self._dest / self._outputs[name]
        yield path
        if self._ledgers:
            yield ledger_of(path)
