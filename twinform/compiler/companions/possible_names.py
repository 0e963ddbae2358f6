"""Names that a xacro file would give parts with other arguments, as far as its text says so."""

import os
import re
from pathlib import Path

from twinform.compiler.input.include_graph import IncludeGraph
from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass

_CHOICE = re.compile(r"<xacro:(?:if|unless)\b|load_yaml")
_NAMED = re.compile(r"<(?:link|joint|sensor|gpio|group)\s[^<>]*?\bname\s*=\s*[\"']([^\"']*)[\"']")
_EXPRESSION = re.compile(r"\$\{[^}]*\}|\$\([^)]*\)")
_SHORTEST = 3
"""The fewest letters outside of expressions that say anything about a name."""
_MOST = 2000


@dataclass(frozen=True, slots=True)
class PossibleNames:
    """Names in the files of a robot or of SRDF, with what stands before and behind expressions in others."""

    literal: frozenset[str] = frozenset()
    ends: frozenset[tuple[str, str]] = frozenset()

    def __contains__(self, name: str) -> bool:
        return name in self.literal or any(
            len(name) >= len(before) + len(behind) and name.startswith(before) and name.endswith(behind)
            for before, behind in self.ends
        )


def possible_names(robot: Path, search: SearchPath) -> PossibleNames:
    """Return the names that parts of a file may have with other arguments; none where they do not depend on any."""
    if not robot.name.lower().endswith(".xacro"):
        return PossibleNames()
    texts = [_text(file, robot, search) for file, _ in IncludeGraph(search).closure(os.path.realpath(robot))]
    if not any(map(_CHOICE.search, texts)):
        return PossibleNames()
    names = {name for text in texts for name in _NAMED.findall(text)}
    made = {name for name in names if "$" in name}
    pieces = (_EXPRESSION.split(name) for name in made)
    ends = sorted({(each[0], each[-1]) for each in pieces if len(each[0]) + len(each[-1]) >= _SHORTEST})
    return PossibleNames(frozenset(names - made), frozenset(ends[:_MOST]))


def _text(file: str, robot: Path, search: SearchPath) -> str:
    try:
        return search.readable(robot).read(file, LARGEST).decode(errors="replace")
    except (OSError, ValueError):
        return ""
