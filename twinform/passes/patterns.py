"""Names by pattern, as options of passes have them."""

from collections.abc import Iterable
from fnmatch import fnmatchcase


def matches(name: str | None, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns matches a name, in the case that it has; no name is the empty one."""
    return any(fnmatchcase(name or "", pattern) for pattern in patterns)
