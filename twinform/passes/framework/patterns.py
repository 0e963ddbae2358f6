"""Name patterns in the options of passes: one or several, of which one has to match."""

from collections.abc import Iterable
from fnmatch import fnmatchcase

EVERY = ("*",)
"""What an option has that leaves nothing out."""


def with_such_a_name(what: str) -> str:
    """The description of an option that selects by patterns."""
    return f"{what} with such a name; `*`, `?` and `[...]` are wildcards."


def matches(name: str | None, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns matches a name, in the case that it has; no name is the empty one."""
    return any(fnmatchcase(name or "", pattern) for pattern in patterns)
