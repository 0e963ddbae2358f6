"""Test cases as data: a model file whose comments have the diagnostics that are expected in it.

A comment `<!-- expect: severity rule-name -->` stands on the line that the finding is reported at; several of them may
stand there. Findings of severity `info` need not be listed, but those that are must be there; errors and warnings must
be listed. Beside `NAME.urdf` may lie `NAME.expected.sdf`, or the other way round: what the file becomes. What a case
reads besides its file lies in a folder `parts`.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypedDict

from twinform.compiler import CompileError, check, convert
from twinform.diagnostics import Diagnostic, Severity

_EXPECT = re.compile(rb"<!--\s*expect:\s*(?P<severity>\w+)\s+(?P<rule>[\w-]+)\s*-->")
_OTHER: dict[str, Literal["sdf", "urdf"]] = {".urdf": "sdf", ".sdf": "urdf"}
_SUFFIXES = frozenset({*_OTHER, ".xacro"})
_PARTS = "parts"

Finding = tuple[int, str, str]
"""line, severity, rule"""


class CaseCheckOptions(TypedDict, total=False):
    """What `check` is asked for besides the file."""

    paths: tuple[Path, ...]
    expand_includes: bool


@dataclass(frozen=True, slots=True)
class Case:
    """One case file."""

    path: Path
    strict: bool = False
    options: CaseCheckOptions = field(default_factory=CaseCheckOptions)

    @property
    def expected(self) -> Counter[Finding]:
        """What the comments announce."""
        lines = self.path.read_bytes().splitlines()
        return Counter(
            (number, found["severity"].decode(), found["rule"].decode())
            for number, line in enumerate(lines, 1)
            for found in _EXPECT.finditer(line)
        )

    @property
    def found(self) -> Counter[Finding]:
        """What the compiler reports."""
        return findings(check(self.path, strict=self.strict, **self.options).diagnostics, str(self.path))

    def mismatches(self, in_full: Collection[str] = ()) -> list[str]:
        """A line for each finding that is missing, and for each that is too many.

        Rules `in_full` must be listed whatever their severity.
        """
        missing, extra = self.expected - self.found, self.found - self.expected
        extra = {each: count for each, count in extra.items() if each[1] != str(Severity.INFO) or each[2] in in_full}
        return [
            *(f"{self.path.name}:{line}: expected {severity} {rule}" for line, severity, rule in sorted(missing)),
            *(f"{self.path.name}:{line}: unexpected {severity} {rule}" for line, severity, rule in sorted(extra)),
        ]

    @property
    def output_path(self) -> Path:
        """Where the expected output lies, if there is one."""
        return self.path.with_suffix(f".expected.{_OTHER[self.path.suffix]}")

    def output(self, sdf_version: str | None = None, *, to: Literal["sdf", "urdf"] | None = None) -> str:
        """What the file becomes, by default in the other format; the findings where it does not become anything."""
        to = to or _OTHER[self.path.suffix]
        try:
            return convert(self.path, to=to, sdf_version=sdf_version, strict=self.strict, comments=False).text
        except CompileError as error:
            return "\n".join(f"{each.location.line}: {each.rule.name}" for each in error.diagnostics if each.is_error)


def findings(diagnostics: Iterable[Diagnostic], file: str) -> Counter[Finding]:
    """What a case can announce: findings in its own file, or in none."""
    return Counter(
        (each.location.line, str(each.severity), each.rule.name)
        for each in diagnostics
        if each.location.file in {"", file}
    )


def cases(folder: Path, *, options: CaseCheckOptions | None = None) -> list[Case]:
    """Every case of a folder and those below it, in the order of their names, without parts and expected outputs."""
    return [Case(path, options=options or {}) for path in sorted(folder.rglob("*")) if _is_case(path, folder)]


def _is_case(path: Path, folder: Path) -> bool:
    if _PARTS in path.relative_to(folder).parts[:-1]:
        return False
    return path.suffix in _SUFFIXES and ".expected" not in path.suffixes
