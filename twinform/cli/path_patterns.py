"""Patterns of paths in the notation of `.gitignore`: the patterns, `.gitignore` files, and walks that respect both."""

import os
import re
import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field
from pathlib import Path
from typing import TYPE_CHECKING, Any, AnyStr, Self

from pathspec import GitIgnoreSpec

from twinform.cli.model_files import Exclusion, FileKind, PatternError, is_model
from twinform.dataclass import dataclass
from twinform.file_access import REPOSITORY, has_any, read_regular

if TYPE_CHECKING:
    from pathspec.patterns.gitignore.spec import GitIgnoreSpecPattern
else:
    try:
        from pathspec.patterns.gitignore.spec import GitIgnoreSpecPattern
    except ImportError:  # before pathspec 1.0
        from pathspec.patterns.gitwildmatch import GitWildMatchPattern as GitIgnoreSpecPattern

# re2, the optional engine since pathspec 1.0, is linear too, but it is a compiled dependency for a few patterns
ENGINE: dict[str, Any] = {"backend": "simple"} if "gitignore" in GitIgnoreSpecPattern.__module__ else {}
"""The options of pathspec that choose its engine in Python, where there are others."""
LONGEST = 4096
"""The longest pattern in characters, which is as long as a path may be."""
MOST = 2000
"""The most patterns of a file or setting; compiling one takes as long as reading a hundred lines."""
_FOLDERS_BETWEEN = "(?:/.+)?"
"""The expression of pathspec for `/**` between two names."""
_FOLDERS_BEFORE = "^(?:.+/)?"
"""The expression of pathspec for `**/` before the first name."""
# The expression of pathspec for `*`. Brackets and names contain no slash, so none of the three means anything else.
_STAR = "[^/]*"
_ONE = "[^/]"


# Tests compare these expressions with pathspec, and pathspec with `git ls-files`.
class _LinearPattern(GitIgnoreSpecPattern):
    """A pattern that matches in linear time.

    The text between two wildcards may be matched where it is found first, because the second wildcard takes the rest.
    pathspec's own expressions try every place, in all combinations: `*a*a*a*a*b` took minutes.
    """

    @classmethod
    def pattern_to_regex(cls, pattern: AnyStr) -> tuple[AnyStr | None, bool | None]:
        if len(pattern) > LONGEST:
            raise ValueError(f"a pattern of {len(pattern):,} characters; the limit is {LONGEST:,}")
        regex, include = super().pattern_to_regex(pattern)
        return _without_retries(regex) if isinstance(regex, str) else regex, include


def _without_retries(regex: str) -> str:
    """Change a regular expression of pathspec so that it finds the same paths and never retries a wildcard."""
    *found_first, last = regex.split(_FOLDERS_BETWEEN)
    names = [_with_stars_found_first(each) for each in found_first]
    if not names:
        return _with_stars_found_first(last)
    first = names[0].replace(_FOLDERS_BEFORE, "^(?:.+?/)??", 1)
    between = [f"(?>(?:/.+?)??{each}(?=/))" for each in names[1:]]
    return f"(?>{first}(?=/)){''.join(between)}{_FOLDERS_BETWEEN}{_with_stars_found_first(last)}"


def _with_stars_found_first(regex: str) -> str:
    """Change part of a regular expression of pathspec so that only the last star of each name is retried."""
    before, *behind = regex.split(_STAR)
    if not behind:
        return before
    *middle, last = behind
    return before + "".join(map(_star_and_name, middle)) + _STAR + last


def _star_and_name(name: str) -> str:
    is_last = "/" in name.replace(_ONE, "")
    return f"{_STAR}{name}" if is_last else f"(?>{_STAR}?{name})"


@dataclass(frozen=True, slots=True)
class PathPatterns:
    """Patterns, and the absolute path of the folder that they are relative to."""

    folder: str
    spec: GitIgnoreSpec

    @classmethod
    def of(cls, folder: str | Path, lines: Iterable[str]) -> "PathPatterns":
        """Parse lines of text, without blank lines and comments.

        Raises:
            PatternError: a pattern is invalid.
        """
        written = [line for line in lines if line.strip() and not line.startswith("#")]
        if len(written) > MOST:
            raise PatternError(f"{len(written):,} patterns; the limit is {MOST:,}")
        try:
            with warnings.catch_warnings():
                # re warns of brackets such as `[[a]`, which may mean something else in later versions
                warnings.simplefilter("ignore", FutureWarning)
                spec = GitIgnoreSpec.from_lines(written, _LinearPattern, **ENGINE)
        except (ValueError, re.error) as error:
            raise PatternError(str(error)) from error
        return cls(os.path.abspath(folder), spec)  # noqa: PTH100 - links stay links

    def is_around(self, path: str) -> bool:
        """Whether an absolute path is the folder or in it."""
        return path == self.folder or path.startswith(os.path.join(self.folder, ""))  # noqa: PTH118 - with a separator

    def decide(self, path: str, *, is_folder: bool = False) -> bool | None:
        """Whether the patterns include an absolute path; None if none of them fits it, or if it is outside."""
        if path == self.folder or not self.is_around(path):
            return None
        inside = os.path.relpath(path, self.folder).replace(os.sep, "/")
        return self.spec.check_file(f"{inside}/" if is_folder else inside).include

    def match(self, path: str, *, is_folder: bool = False) -> bool:
        """Whether the patterns include an absolute path."""
        return bool(self.decide(path, is_folder=is_folder))


_LARGEST = 2**20
"""The most bytes of a `.gitignore` that are read."""
_EXCLUDE = Path("info", "exclude")


@dataclass(frozen=True, slots=True)
class GitIgnore:
    """The `.gitignore` files that apply in a folder, the nearest last."""

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
        # a folder that git ignores as a whole was named by the user; then only the files in it decide
        return cls() if found.ignores(str(real), is_folder=True) else found

    def inside(self, folder: str) -> Self:
        """Add the patterns of a folder below; a repository in another one starts anew."""
        here = Path(folder)
        before = () if _is_top(here) else self.patterns
        own = [_read(folder, here / ".gitignore")]
        if _is_top(here):
            # The user's own patterns (`core.excludesFile`) do not count: every machine checks the same models.
            own.insert(0, _read(folder, _git_folder(here) / _EXCLUDE))
        return type(self)((*before, *(each for each in own if each)))

    def ignores(self, path: str, *, is_folder: bool = False) -> bool:
        """Whether an absolute path is ignored; the nearest `.gitignore` with a pattern that fits decides."""
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
            return None  # git follows no links here either
        data = read_regular(file, _LARGEST)[:_LARGEST]
        return PathPatterns.of(folder, data.decode("utf-8-sig", "surrogateescape").splitlines())
    except (OSError, PatternError):
        return None  # git skips unreadable files, too


def _git_folder(top: Path) -> Path:
    """Return the folder `.git` or, for a worktree or submodule, the folder that the file `.git` names."""
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


_HIDDEN = "."


@dataclass(slots=True)
class FolderWalk:
    """A walk through a folder for files that fit `wanted`, or for all of a `kind`.

    Files that are hidden, excluded or ignored by git are left out.
    """

    top: str
    exclusion: Exclusion
    wanted: PathPatterns | None = None
    named: bool = False
    kind: FileKind = is_model
    left_out: int = 0
    _patterns: dict[tuple[Path, Sequence[str]], PathPatterns] = field(init=False)

    def __post_init__(self) -> None:
        self._patterns = {}

    def _excluded_in(self, folder: str) -> PathPatterns:
        exclusion = self.exclusion.of_folder(folder)
        key = (exclusion.folder, exclusion.patterns)
        if key not in self._patterns:
            found = PathPatterns.of(exclusion.folder, exclusion.patterns)
            here = os.path.abspath(folder)  # noqa: PTH100 - links stay links
            if not found.is_around(here) or found.match(here, is_folder=True):
                # the user named the folder, so only files in it are excluded
                found = PathPatterns.of(folder, exclusion.patterns)
            self._patterns[key] = found
        return self._patterns[key]

    def run(self) -> Iterator[str]:
        """Yield the files in any order; links to folders are not followed, so the walk ends."""
        pending = [(self.top, GitIgnore.around(Path(self.top)))]
        while pending:
            folder, ignore = pending.pop()
            try:
                entries = list(os.scandir(folder))
            except OSError:
                yield folder
                continue
            ignore, excluded = ignore.inside(os.path.realpath(folder)), self._excluded_in(folder)
            for entry in entries:
                is_folder = entry.is_dir(follow_symlinks=False)
                if self._is_left_out(entry, ignore, excluded, is_folder=is_folder):
                    self.left_out += not is_folder and self._is_wanted(entry)
                elif is_folder:
                    pending.append((self._name(entry), ignore))
                elif self._is_wanted(entry):
                    yield self._name(entry)

    def _name(self, entry: os.DirEntry[str]) -> str:
        return entry.path.removeprefix(f".{os.sep}") if self.top == "." else entry.path

    @staticmethod
    def _is_left_out(entry: os.DirEntry[str], ignore: GitIgnore, excluded: PathPatterns, *, is_folder: bool) -> bool:
        if entry.name.startswith(_HIDDEN):
            return True
        real = os.path.join(os.path.realpath(os.path.dirname(entry.path)), entry.name)  # noqa: PTH118, PTH120 - for speed
        path = os.path.abspath(entry.path)  # noqa: PTH100 - links stay links
        return excluded.match(path, is_folder=is_folder) or ignore.ignores(real, is_folder=is_folder)

    def _is_wanted(self, entry: os.DirEntry[str]) -> bool:
        if self.wanted is not None and not self.wanted.match(os.path.abspath(entry.path)):  # noqa: PTH100 - as above
            return False
        is_link_to_folder = entry.is_symlink() and os.path.isdir(entry.path)  # noqa: PTH112 - a circle is no folder
        return not is_link_to_folder and self.kind(Path(entry.path), named=self.named)
