"""Model files that a command line means: files, folders and globs, with `.gitignore` and `exclude` respected."""

from twinform.cli.files.discovery import NothingFoundError, discover
from twinform.cli.files.exclusion import DEFAULT_EXCLUDE, Exclusion, PatternError

__all__ = ["DEFAULT_EXCLUDE", "Exclusion", "NothingFoundError", "PatternError", "discover"]
