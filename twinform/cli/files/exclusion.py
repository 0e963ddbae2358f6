"""`exclude`: files and folders of a project that are left out where nobody names them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

DEFAULT_EXCLUDE = ("build/", "install/", "log/", "node_modules/", "venv/", "site-packages/", "__pycache__/")
"""What is left out where the project says nothing: what tools make. Hidden files and folders are left out as well."""


class PatternError(ValueError):
    """A pattern of paths that git would not take."""


@dataclass(frozen=True, slots=True)
class Exclusion:
    """Patterns, relative to a folder or, for a walk that begins outside of it, to where that begins.

    `force` is whether they count for files that are named, too.
    """

    patterns: Sequence[str] = DEFAULT_EXCLUDE
    folder: Path = Path()
    force: bool = False
