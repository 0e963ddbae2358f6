"""Known causes: why what a section finds is right as it is, by hand, in the `.toml` file beside its module."""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import cast


@dataclass(frozen=True)
class Cause:
    """Why something is right, and a pattern for each aspect of what it is about; other aspects may be anything."""

    table: str
    patterns: Mapping[str, str]
    reason: str


class Known:
    """The causes of a file: of several that fit, the first counts.

    A table has names, which may be patterns, with a reason each; or it is a list of rows, with a pattern for each
    aspect and the `reason`.
    """

    def __init__(self, path: Path, fits: Callable[[str, str], object] = fnmatchcase) -> None:
        tables = cast("_Tables", tomllib.loads(path.read_text(encoding="utf-8")))
        self.path, self.fits = path, fits
        self.causes = [cause for table, rows in tables.items() for cause in _causes(table, rows)]
        self.used = set[int]()

    @classmethod
    def beside(cls, module: str, fits: Callable[[str, str], object] = fnmatchcase) -> "Known":
        """Those of the section whose module this file is."""
        return cls(Path(module).with_suffix(".toml"), fits)

    def why(self, table: str, name: str = "", **aspects: str) -> str:
        """Why it is right; empty where nobody has examined it."""
        texts = {"name": name, **aspects}
        for index, cause in enumerate(self.causes):
            if cause.table == table and all(self._fits(texts[key], text) for key, text in cause.patterns.items()):
                self.used.add(index)
                return cause.reason
        return ""

    def unused(self) -> list[str]:
        """The causes that nothing asked for since the file was read."""
        return [
            f"{self.path.parent.name}/{self.path.name}: explained, and not there: {dict(cause.patterns)}"
            for index, cause in enumerate(self.causes)
            if index not in self.used
        ]

    def _fits(self, value: str, pattern: str) -> bool:
        return value == pattern or bool(self.fits(value, pattern))


def contains(text: str, pattern: str) -> object:
    """Whether a regular expression is found in a text, for files whose patterns are such."""
    return re.search(pattern, text)


_Tables = dict[str, dict[str, str] | list[dict[str, str]]]


def _causes(table: str, rows: dict[str, str] | list[dict[str, str]]) -> list[Cause]:
    if isinstance(rows, dict):
        return [Cause(table, {"name": name}, reason) for name, reason in rows.items()]
    return [Cause(table, {key: text for key, text in row.items() if key != "reason"}, row["reason"]) for row in rows]
