"""Walks through a folder for models: hidden files, excluded ones and those that git ignores are left out."""

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from twinform.cli.files.exclusion import Exclusion
from twinform.cli.files.gitignore import GitIgnore
from twinform.cli.files.model_files import FileKind, is_model
from twinform.cli.files.patterns import PathPatterns

_HIDDEN = "."


@dataclass(slots=True)
class FolderWalk:
    """One run through a folder; `wanted` are the files that count, all of the `kind` without it."""

    top: str
    exclusion: Exclusion
    wanted: PathPatterns | None = None
    named: bool = False
    kind: FileKind = is_model
    left_out: int = 0
    excluded: PathPatterns = field(init=False)

    def __post_init__(self) -> None:
        self.excluded = PathPatterns.of(self.exclusion.folder, self.exclusion.patterns)
        here = os.path.abspath(self.top)  # noqa: PTH100 - links stay links
        if not self.excluded.is_around(here) or self.excluded.match(here, is_folder=True):
            # it was named, so only what is in it is excluded
            self.excluded = PathPatterns.of(self.top, self.exclusion.patterns)

    def run(self) -> Iterator[str]:
        """The files in any order; links to folders are not followed, so that no way leads in a circle."""
        pending = [(self.top, GitIgnore.around(Path(self.top)))]
        while pending:
            folder, ignore = pending.pop()
            try:
                entries = list(os.scandir(folder))
            except OSError:
                yield folder
                continue
            ignore = ignore.inside(os.path.realpath(folder))
            for entry in entries:
                is_folder = entry.is_dir(follow_symlinks=False)
                if self._is_left_out(entry, ignore, is_folder=is_folder):
                    self.left_out += not is_folder and self._is_wanted(entry)
                elif is_folder:
                    pending.append((self._name(entry), ignore))
                elif self._is_wanted(entry):
                    yield self._name(entry)

    def _name(self, entry: os.DirEntry[str]) -> str:
        return entry.path.removeprefix(f".{os.sep}") if self.top == "." else entry.path

    def _is_left_out(self, entry: os.DirEntry[str], ignore: GitIgnore, *, is_folder: bool) -> bool:
        if entry.name.startswith(_HIDDEN):
            return True
        real = os.path.join(os.path.realpath(os.path.dirname(entry.path)), entry.name)  # noqa: PTH118, PTH120 - for speed
        path = os.path.abspath(entry.path)  # noqa: PTH100 - links stay links
        return self.excluded.match(path, is_folder=is_folder) or ignore.ignores(real, is_folder=is_folder)

    def _is_wanted(self, entry: os.DirEntry[str]) -> bool:
        if self.wanted is not None and not self.wanted.match(os.path.abspath(entry.path)):  # noqa: PTH100 - as above
            return False
        is_link_to_folder = entry.is_symlink() and os.path.isdir(entry.path)  # noqa: PTH112 - a circle is no folder
        return not is_link_to_folder and self.kind(Path(entry.path), named=self.named)
