"""Patterns of paths in the notation of `.gitignore`: for `exclude`, settings of some files, and `.gitignore` itself."""

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from pathspec import GitIgnoreSpec

from twinform.cli.files.exclusion import PatternError


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
        try:
            return cls(os.path.abspath(folder), GitIgnoreSpec.from_lines(lines))  # noqa: PTH100 - links stay links
        except (ValueError, re.error) as error:
            raise PatternError(str(error)) from error

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
