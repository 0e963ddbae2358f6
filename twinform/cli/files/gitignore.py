"""`.gitignore`: the patterns of a folder, of those around it up to the top of the repository, and of the repository."""

from dataclasses import dataclass
from pathlib import Path
from typing import Self

from twinform.cli.files.exclusion import PatternError
from twinform.cli.files.patterns import PathPatterns
from twinform.file_access import REPOSITORY, has_any, read_regular

_LARGEST = 2**20
"""Bytes of a file of patterns; a larger one is none."""
_EXCLUDE = Path("info", "exclude")


@dataclass(frozen=True, slots=True)
class GitIgnore:
    """The files of patterns that count in a folder, the nearest last."""

    patterns: tuple[PathPatterns, ...] = ()

    @classmethod
    def around(cls, folder: Path) -> Self:
        """Return the patterns that apply in a folder because of the folders above it; none outside of a repository."""
        real = folder.resolve()
        above = [real, *real.parents]
        top = next((place for place, each in enumerate(above) if _is_top(each)), None)
        found = cls()
        for each in reversed(above[1 : top + 1] if top else ()):
            found = found.inside(str(each))
        # what git ignores as a whole can still be asked for by its name; then only what is in it decides
        return cls() if found.ignores(str(real), is_folder=True) else found

    def inside(self, folder: str) -> Self:
        """Return the patterns for a folder below: these, then its own. A repository inside another starts anew."""
        here = Path(folder)
        before = () if _is_top(here) else self.patterns
        own = [_read(folder, here / ".gitignore")]
        if _is_top(here):
            # The user's own patterns (`core.excludesFile`) are left out on purpose: the same models
            # are checked on every machine.
            own.insert(0, _read(folder, _git_folder(here) / _EXCLUDE))
        return type(self)((*before, *(each for each in own if each)))

    def ignores(self, path: str, *, is_folder: bool = False) -> bool:
        """Whether an absolute path is ignored; of several files of patterns the nearest decides that knows."""
        for each in reversed(self.patterns):
            decision = each.decide(path, is_folder=is_folder)
            if decision is not None:
                return decision
        return False


def _is_top(folder: Path) -> bool:
    return has_any(folder, REPOSITORY)


def _read(folder: str, file: Path) -> PathPatterns | None:
    try:
        if file.is_symlink():
            return None  # git follows none either
        data = read_regular(file, _LARGEST)[:_LARGEST]
        return PathPatterns.of(folder, data.decode("utf-8-sig", "surrogateescape").splitlines())
    except (OSError, PatternError):
        return None  # git passes over what it cannot read, too


def _git_folder(top: Path) -> Path:
    """Where a repository keeps what it knows: `.git` or, of a worktree or submodule, the folder that it names."""
    entry = top / ".git"
    try:
        if entry.is_dir():
            return entry
        folder = top / _text(entry).partition("gitdir:")[2].strip()
        common = folder / "commondir"
        return folder / _text(common).strip() if common.is_file() else folder
    except (OSError, UnicodeDecodeError):
        return entry


def _text(file: Path) -> str:
    return read_regular(file, _LARGEST).decode()
