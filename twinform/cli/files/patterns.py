"""Patterns of paths in the notation of `.gitignore`: for `exclude`, settings of some files, and `.gitignore` itself."""

import os
import re
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import AnyStr

from pathspec import GitIgnoreSpec
from pathspec.patterns.gitignore.spec import GitIgnoreSpecPattern

from twinform.cli.files.exclusion import PatternError

LONGEST = 4096
"""The longest pattern, in characters: as long as a path may be."""
MOST = 2000
"""The most patterns of a file or setting: making one ready takes as long as reading a hundred of its lines."""
_FOLDERS_BETWEEN = "(?:/.+)?"
"""What pathspec makes of `/**` between two names."""
_FOLDERS_BEFORE = "^(?:.+/)?"
"""What pathspec makes of `**/` before the first name."""
# What pathspec makes of `*`. Brackets and names contain no slash, so these three expressions stand
# for nothing else.
_STAR = "[^/]*"
_ONE = "[^/]"


# pathspec's optional engine re2 is linear too, but it is a compiled dependency for a few patterns.
# A test holds the meaning of these expressions to pathspec, and that of pathspec to `git ls-files`.
class _LinearPattern(GitIgnoreSpecPattern):
    """A pattern that never goes back behind its last `*`, nor behind its last `**`.

    Whatever fits between two wildcards also fits where it is found first, because the second wildcard takes the rest.
    pathspec's regular expressions try every place instead, in all combinations: `*a*a*a*a*b` took minutes.
    """

    @classmethod
    def pattern_to_regex(cls, pattern: AnyStr) -> tuple[AnyStr | None, bool | None]:
        if len(pattern) > LONGEST:
            raise ValueError(f"a pattern of {len(pattern):,} characters; the limit is {LONGEST:,}")
        regex, include = super().pattern_to_regex(pattern)
        return _without_retries(regex) if isinstance(regex, str) else regex, include


def _without_retries(regex: str) -> str:
    """A regular expression of pathspec that finds the same paths and never tries a wildcard twice."""
    *found_first, last = regex.split(_FOLDERS_BETWEEN)
    names = [_with_stars_found_first(each) for each in found_first]
    if not names:
        return _with_stars_found_first(last)
    first = names[0].replace(_FOLDERS_BEFORE, "^(?:.+?/)??", 1)
    between = [f"(?>(?:/.+?)??{each}(?=/))" for each in names[1:]]
    return f"(?>{first}(?=/)){''.join(between)}{_FOLDERS_BETWEEN}{_with_stars_found_first(last)}"


def _with_stars_found_first(regex: str) -> str:
    """Part of a regular expression of pathspec, in which only the last star of each name may be tried again."""
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
    """Patterns and the folder, as an absolute path, that they are relative to."""

    folder: str
    spec: GitIgnoreSpec

    @classmethod
    def of(cls, folder: str | Path, lines: Iterable[str]) -> "PathPatterns":
        """From lines of text; blank ones and comments are passed over.

        Raises:
            PatternError: one is no pattern.
        """
        written = [line for line in lines if line.strip() and not line.startswith("#")]
        if len(written) > MOST:
            raise PatternError(f"{len(written):,} patterns; the limit is {MOST:,}")
        try:
            with warnings.catch_warnings():
                # re warns of brackets such as `[[a]` and `[a--b]`, which may mean something else in later versions
                warnings.simplefilter("ignore", FutureWarning)
                spec = GitIgnoreSpec.from_lines(written, _LinearPattern, backend="simple")
        except (ValueError, re.error) as error:
            raise PatternError(str(error)) from error
        return cls(os.path.abspath(folder), spec)  # noqa: PTH100 - links stay links

    def is_around(self, path: str) -> bool:
        """Whether an absolute path is the folder, or in it."""
        return path == self.folder or path.startswith(os.path.join(self.folder, ""))  # noqa: PTH118 - with a separator

    def decide(self, path: str, *, is_folder: bool = False) -> bool | None:
        """Whether an absolute path is meant; None where no pattern says anything about it, or it is outside."""
        if path == self.folder or not self.is_around(path):
            return None
        inside = os.path.relpath(path, self.folder).replace(os.sep, "/")
        return self.spec.check_file(f"{inside}/" if is_folder else inside).include

    def match(self, path: str, *, is_folder: bool = False) -> bool:
        """Whether an absolute path is meant."""
        return bool(self.decide(path, is_folder=is_folder))
