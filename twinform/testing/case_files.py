"""Test cases as data: a model file whose comments list the diagnostics that are expected in it.

A comment `<!-- expect: severity rule-name -->` stands on the line that the finding is reported at; a line may have
several. Errors and warnings must be listed; findings of severity `info` need not be, but must be found if they are.
`NAME.expected.sdf` beside `NAME.urdf`, or the other way round, is the expected result of converting the file, and
`NAME.expected.xml` that of converting it to MJCF. Other files that a case reads lie in a folder `parts`.

Of a case for passes, a comment `<!-- passes: PIPELINE -->` names the pipeline, and `expect` lists what the passes
report too. They run in the folder of the file. The expected result lies in a file of the same format,
`NAME.expected.urdf` or `NAME.expected.sdf`; there is none if the passes change nothing or refuse the model.
"""

from collections import Counter
from collections.abc import Collection, Iterable
from contextlib import chdir
from dataclasses import field
from functools import cached_property
from pathlib import Path
from typing import Literal, TypedDict

from twinform.compiler import CompileError, Conversion, check, convert
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, LedgerEntry, Severity
from twinform.lazy import lazy_pattern
from twinform.text.tokens import IN_COMMENT

_EXPECT = lazy_pattern(rb"<!--\s*expect:\s*(?P<severity>\w+)\s+(?P<rule>[\w-]+)\s*-->")
_TARGETS: dict[str, Literal["sdf", "urdf"]] = {".urdf": "sdf", ".sdf": "urdf", ".mjcf": "sdf"}
"""What a case is converted to by its ending."""
_SUFFIXES = frozenset({*_TARGETS, ".xacro"})
_PARTS = "parts"

Finding = tuple[int, str, str]
"""Line, severity and name of the rule."""


class CaseCheckOptions(TypedDict, total=False):
    """Options of `check` for a case."""

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
        """The findings that the comments list."""
        lines = self.path.read_bytes().splitlines()
        return Counter(
            (number, found["severity"].decode(), found["rule"].decode())
            for number, line in enumerate(lines, 1)
            for found in _EXPECT.finditer(line)
        )

    @property
    def found(self) -> Counter[Finding]:
        """The findings that the compiler reports."""
        return findings(check(self.path, strict=self.strict, **self.options).diagnostics, str(self.path))

    def mismatches(self, in_full: Collection[str] = ()) -> list[str]:
        """Return a line for each finding that is missing, and for each that was not expected.

        Findings of the rules `in_full` must be listed whatever their severity.
        """
        missing, extra = self.expected - self.found, self.found - self.expected
        extra = {each: count for each, count in extra.items() if each[1] != str(Severity.INFO) or each[2] in in_full}
        return [
            *(f"{self.path.name}:{line}: expected {severity} {rule}" for line, severity, rule in sorted(missing)),
            *(f"{self.path.name}:{line}: unexpected {severity} {rule}" for line, severity, rule in sorted(extra)),
        ]

    @property
    def output_path(self) -> Path:
        """The file of the expected output, which may not exist."""
        return self.path.with_suffix(f".expected.{_TARGETS[self.path.suffix]}")

    def output(self, sdf_version: str | None = None, *, to: Literal["sdf", "urdf"] | None = None) -> str:
        """Convert the file, by default to the counterpart of its format; return the text, or its errors."""
        to = to or _TARGETS[self.path.suffix]
        try:
            return convert(self.path, to=to, sdf_version=sdf_version, strict=self.strict, comments=False).text
        except CompileError as error:
            return "\n".join(f"{each.location.line}: {each.rule.name}" for each in error.diagnostics if each.is_error)


def findings(diagnostics: Iterable[Diagnostic], file: str) -> Counter[Finding]:
    """Count the findings in a file; those without a file count too, since a case can list them."""
    return Counter(
        (each.location.line, str(each.severity), each.rule.name)
        for each in diagnostics
        if each.location.file in {"", file}
    )


def cases(folder: Path, *, options: CaseCheckOptions | None = None) -> list[Case]:
    """Return every case in a folder and the folders below it, sorted by name."""
    return [Case(path, options=options or {}) for path in sorted(folder.rglob("*")) if _is_case(path, folder)]


def _is_case(path: Path, folder: Path) -> bool:
    if _PARTS in path.relative_to(folder).parts[:-1]:
        return False
    return path.suffix in _SUFFIXES and ".expected" not in path.suffixes


@dataclass(frozen=True)
class MjcfCase(Case):
    """A case file that is converted to MJCF, without carriers: what the elements of MJCF say is what it shows."""

    @property
    def found(self) -> Counter[Finding]:
        """The findings that the conversion reports."""
        return findings(self._outcome.diagnostics, self.path.name)

    @property
    def output_path(self) -> Path:
        """The file of the expected output; there is none for a model that is refused."""
        return self.path.with_suffix(".expected.xml")

    @property
    def rules(self) -> frozenset[str]:
        """The names of all rules that were reported, by a finding or an entry of the ledger."""
        return _rules_of(self._outcome)

    @property
    def text(self) -> str | None:
        """The MJCF; None where the model is refused."""
        return self._outcome.text if isinstance(self._outcome, Conversion) else None

    @cached_property
    def _outcome(self) -> Conversion | CompileError:
        with chdir(self.path.parent):
            try:
                return convert(Path(self.path.name), to="mjcf", carriers=False, comments=False, strict=self.strict)
            except CompileError as error:
                return error


def _rules_of(outcome: Conversion | CompileError) -> frozenset[str]:
    found: tuple[Diagnostic | LedgerEntry, ...] = outcome.diagnostics
    if isinstance(outcome, Conversion):
        found = (*found, *outcome.ledger.entries)
    return frozenset(each.rule.name for each in found)


def mjcf_cases(folder: Path) -> list[MjcfCase]:
    """Return every case for MJCF in a folder and the folders below it, sorted by name."""
    return [MjcfCase(case.path) for case in cases(folder)]


_PASSES = lazy_pattern(rf"<!--\s*+passes:(?P<pipeline>{IN_COMMENT})(?:-->)?")
_FORMATS: dict[str, Literal["sdf", "urdf"]] = {".urdf": "urdf", ".sdf": "sdf"}


@dataclass(frozen=True)
class PassCase(Case):
    """A case file for a pipeline of passes."""

    @property
    def pipeline(self) -> str:
        """The pipeline that the file names."""
        found = _PASSES.search(self.path.read_text(encoding="utf-8"))
        if found is None:
            raise ValueError(f"{self.path.name} has no <!-- passes: ... -->")
        return found["pipeline"].strip()

    @property
    def found(self) -> Counter[Finding]:
        """The findings that the compiler and the passes report."""
        return findings(self._outcome.diagnostics, self.path.name)

    @property
    def rules(self) -> frozenset[str]:
        """The names of all rules that were reported, by a finding or an entry of the ledger."""
        return _rules_of(self._outcome)

    @property
    def output_path(self) -> Path:
        """The file of the expected output, which may not exist."""
        return self.path.with_suffix(f".expected{self.path.suffix}")

    @property
    def changed(self) -> str | None:
        """The text after the passes; None if they change nothing or refuse the model."""
        made = self._outcome
        if isinstance(made, CompileError):
            return None
        unchanged = self._run(Path(self.path.name), "")
        return None if isinstance(unchanged, Conversion) and made.text == unchanged.text else made.text

    @property
    def settles(self) -> bool:
        """Whether running the passes again changes nothing more."""
        if isinstance(self._outcome, CompileError):
            return True
        again = self._run(self._outcome.text.encode(), self.pipeline)
        return isinstance(again, Conversion) and again.text == self._outcome.text

    @cached_property
    def _outcome(self) -> Conversion | CompileError:
        return self._run(Path(self.path.name), self.pipeline)

    def _run(self, source: Path | bytes, pipeline: str) -> Conversion | CompileError:
        with chdir(self.path.parent):
            try:
                return convert(
                    source, to=_FORMATS[self.path.suffix], passes=pipeline, strict=self.strict, comments=False
                )
            except CompileError as error:
                return error


def pass_cases(folder: Path) -> list[PassCase]:
    """Return every case for passes in a folder and the folders below it, sorted by name."""
    return [PassCase(case.path) for case in cases(folder)]
