"""Baselines: findings that are known and not reported, kept in a JSON file with a line for each.

A finding is known by its file, rule, path and message, without numbers of lines, columns and places among siblings: it
stays the same one when something before it moves. How often it occurs is counted, so that one more is a new one.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field
from functools import cached_property
from typing import Any, NamedTuple, cast

from twinform.dataclass import dataclass
from twinform.diagnostics.diagnostic import Diagnostic, Severity
from twinform.lazy import lazy_pattern

_MARK = "twinform-baseline"
_VERSION = 1
_FINDINGS = "findings"
_PLACES = lazy_pattern(r"\[\d+\]")
_LINES = lazy_pattern(r"\b(line|lines|column) \d+")
# Characters of a message that are kept. Longer ones quote the file, and begin with what is wrong.
_LONGEST = 300


class BaselineError(ValueError):
    """A text is not a baseline; `line` is 0 if unknown."""

    def __init__(self, problem: str, line: int = 0) -> None:
        super().__init__(problem)
        self.line = line


class KnownFinding(NamedTuple):
    """The key of a known finding; `file` is the one that it is in, whichever other file includes that."""

    file: str
    rule: str
    path: str
    message: str


Relative = Callable[[str], str]
"""Gives the name of a file relative to the folder of the baseline, with `/`."""


@dataclass(frozen=True)  # no slots: what is known of each file is kept in the dictionary
class Baseline:
    """Known findings, and how often each occurs."""

    counts: Mapping[KnownFinding, int] = field(default_factory=dict[KnownFinding, int])

    @cached_property
    def by_file(self) -> Mapping[str, Mapping[KnownFinding, int]]:
        """The counts of each file."""
        found: dict[str, dict[KnownFinding, int]] = {}
        for known, count in self.counts.items():
            found.setdefault(known.file, {})[known] = count
        return found

    @classmethod
    def of(cls, findings: Iterable[KnownFinding]) -> "Baseline":
        """Make the baseline of all findings of some files."""
        return cls(Counter(findings))

    @classmethod
    def parse(cls, text: str) -> "Baseline":
        """Parse a baseline.

        Raises:
            BaselineError: it is none, or one of another version.
        """
        try:
            found: object = json.loads(text)
        except json.JSONDecodeError as error:
            raise BaselineError(f"this is no JSON: {error.msg}", error.lineno) from error
        except (RecursionError, ValueError) as error:
            raise BaselineError(f"this is no JSON: {error}") from error
        table = cast("dict[str, object]", found) if isinstance(found, dict) else {}
        if _MARK not in table:
            raise BaselineError(f"this is no baseline: it has no key {_MARK!r}", 1)
        if table[_MARK] != _VERSION:
            problem = f"this is a baseline of version {table[_MARK]!r}, and this twinform knows version {_VERSION}"
            raise BaselineError(problem, _line_of(text, f'"{_MARK}"', 1))
        rows = table.get(_FINDINGS)
        if not isinstance(rows, list):
            raise BaselineError(f"{_FINDINGS!r} has to be a list", _line_of(text, f'"{_FINDINGS}"', 1))
        counts: Counter[KnownFinding] = Counter()
        for number, row in enumerate(cast("list[object]", rows), start=1):
            known, count = _parsed(row, _line_of(text, '{"file"', number))
            counts[known] += count
        return cls(counts)

    def to_json(self) -> str:
        """Write the baseline as JSON, sorted, with a line for each finding."""
        rows = [json.dumps(_row(known, count), ensure_ascii=False) for known, count in sorted(self.counts.items())]
        listed = "".join(f"\n    {row}{',' if place < len(rows) else ''}" for place, row in enumerate(rows, start=1))
        return f'{{\n  "{_MARK}": {_VERSION},\n  "{_FINDINGS}": [{listed}{chr(10) + "  " if rows else ""}]\n}}\n'

    def merged(self, newer: "Baseline", files: Iterable[str]) -> "Baseline":
        """Return the baseline with the findings of these files replaced by those of a newer one."""
        done = set(files)
        kept = {known: count for known, count in self.counts.items() if known.file not in done}
        return Baseline({**kept, **newer.counts})


@dataclass(slots=True)
class BaselineRun:
    """Compares findings with a baseline, file by file; `found` collects all findings that a baseline can have."""

    baseline: Baseline
    relative: Relative
    files: set[str] = field(default_factory=set[str])
    found: Counter[KnownFinding] = field(default_factory=Counter[KnownFinding])

    def of_file(self, path: str) -> "BaselineRun":
        """Return a run for one file alone, whose result `add` takes."""
        name = self.relative(path)
        return BaselineRun(Baseline(self.baseline.by_file.get(name, {})), self.relative)

    def add(self, files: Iterable[str], found: Mapping[KnownFinding, int]) -> None:
        """Add the findings of files, which were compared with the baseline elsewhere.

        `files` are those in which there is nothing else: the checked file and those that it includes, but none where it
        could not be read, so that what the baseline has of it stays.
        """
        self.files.update(map(self.relative, files))
        self.found.update(found)

    def unknown(self, path: str, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """Return the findings about the file at `path` that the baseline lacks; notes are never in one."""
        return tuple(each for each in diagnostics if not self._is_known(each, path))

    def _is_known(self, diagnostic: Diagnostic, path: str) -> bool:
        if diagnostic.severity is Severity.INFO:
            return False
        known = known_by(diagnostic, path, self.relative)
        self.found[known] += 1
        return self.found[known] <= self.baseline.counts.get(known, 0)

    @property
    def gone(self) -> int:
        """Count the findings in the baseline that no longer occur in the files that were checked."""
        counts = self.baseline.counts.items()
        return sum(max(0, count - self.found[known]) for known, count in counts if known.file in self.files)

    def updated(self, exists: Callable[[str], bool]) -> Baseline:
        """Return the new baseline: what was found, and the entries of existing files that were not checked."""
        whole = self.baseline.merged(Baseline(self.found), self.files)
        return Baseline({known: count for known, count in whole.counts.items() if exists(known.file)})


def known_by(diagnostic: Diagnostic, path: str, relative: Relative) -> KnownFinding:
    """Return the key of a finding about the file at `path`."""
    where = diagnostic.location
    # Other tools keep hashes, which nobody can review, or lines, which move with every edit. The
    # price: a message that is reworded in a new version makes its finding new.
    message = _LINES.sub(r"\1 N", diagnostic.message)[:_LONGEST]
    return KnownFinding(relative(where.file or path), diagnostic.rule.name, _PLACES.sub("", where.path), message)


def _row(known: KnownFinding, count: int) -> dict[str, object]:
    return known._asdict() if count == 1 else {**known._asdict(), "count": count}


def _parsed(row: object, line: int) -> tuple[KnownFinding, int]:
    cells = cast("dict[str, Any]", row) if isinstance(row, dict) else {}
    count = cells.pop("count", 1)
    if {*cells} != {*KnownFinding._fields}:
        words = f"a finding is an object with {', '.join(KnownFinding._fields)}, and perhaps count"
        raise BaselineError(words, line)
    if not all(isinstance(each, str) for each in cells.values()) or type(count) is not int or count < 1:
        raise BaselineError("what a finding is known by is text, and its count a positive whole number", line)
    return KnownFinding(**cells), count


def _line_of(text: str, start: str, number: int) -> int:
    """Return the line on which the n-th entry begins; 0 if the file is laid out differently."""
    lines = (line for line, content in enumerate(text.splitlines(), start=1) if content.strip().startswith(start))
    return next((line for place, line in enumerate(lines, start=1) if place == number), 0)
