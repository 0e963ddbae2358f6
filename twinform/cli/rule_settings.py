"""The rules that one table of a configuration or one command line names."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple


class RuleSettings(NamedTuple):
    """The rules that a table of the configuration or a command line names, and the key of the table.

    With `select` nothing else is reported, `extend_select` adds to that, `allow` and `ignore` both leave rules out, and
    findings of `deny` are errors.
    """

    allow: Sequence[str] = ()
    deny: Sequence[str] = ()
    ignore: Sequence[str] = ()
    select: Sequence[str] = ()
    extend_select: Sequence[str] = ()
    key: str = ""

    def named(self) -> Iterator[tuple[str, str]]:
        """Yield each key with each rule or group that it has."""
        for option in ("allow", "deny", "ignore", "select", "extend_select"):
            yield from ((option.replace("_", "-"), name) for name in getattr(self, option))
