"""Looking parts up by their names."""

from collections.abc import Mapping
from typing import TypeVar

from twinform.diagnostics.did_you_mean import did_you_mean

AnyPart = TypeVar("AnyPart")


def look_up(parts: Mapping[str, AnyPart], name: str, kind: str) -> AnyPart:
    """The part of a name.

    Raises:
        KeyError: there is none; the message has the name that may be meant.
    """
    if name in parts:
        return parts[name]
    help_ = did_you_mean(name, parts)
    raise KeyError(f"there is no {kind} {name!r}{f'; {help_}' if help_ else ''}")
