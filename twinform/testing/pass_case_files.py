"""Test cases of passes as data: a model file with the pipeline to run and the expected diagnostics.

A comment `<!-- passes: PIPELINE -->` names the passes; what `case_files.py` has on `expect` holds here for what they
report and what is found in the source. They run in the folder of the file, where relative paths begin. Beside
`NAME.urdf` lies `NAME.expected.urdf`, and beside `NAME.sdf` `NAME.expected.sdf`: the file after the passes. Where they
change nothing, or refuse the model, there is none.
"""

import re
from collections import Counter
from contextlib import chdir
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

from twinform.compiler import CompileError, Conversion, convert
from twinform.diagnostics import Diagnostic, LedgerEntry
from twinform.testing.case_files import Case, Finding, cases, findings
from twinform.text.tokens import IN_COMMENT

_PASSES = re.compile(rf"<!--\s*+passes:(?P<pipeline>{IN_COMMENT})(?:-->)?")
_FORMATS: dict[str, Literal["sdf", "urdf"]] = {".urdf": "urdf", ".sdf": "sdf"}


@dataclass(frozen=True)
class PassCase(Case):
    """One case of a pipeline."""

    @property
    def pipeline(self) -> str:
        """The passes that the file names."""
        found = _PASSES.search(self.path.read_text(encoding="utf-8"))
        if found is None:
            raise ValueError(f"{self.path.name} has no <!-- passes: ... -->")
        return found["pipeline"].strip()

    @property
    def found(self) -> Counter[Finding]:
        """What the compiler and the passes report."""
        return findings(self._outcome.diagnostics, self.path.name)

    @property
    def rules(self) -> frozenset[str]:
        """Every rule that was reported, be it by a finding or an entry of the ledger."""
        findings: tuple[Diagnostic | LedgerEntry, ...] = self._outcome.diagnostics
        if isinstance(self._outcome, Conversion):
            findings = (*findings, *self._outcome.ledger.entries)
        return frozenset(each.rule.name for each in findings)

    @property
    def output_path(self) -> Path:
        """Where the expected output lies, if there is one."""
        return self.path.with_suffix(f".expected{self.path.suffix}")

    @property
    def changed(self) -> str | None:
        """The file after the passes; None where they leave it as it is, or refuse it."""
        made = self._outcome
        if isinstance(made, CompileError):
            return None
        unchanged = self._run(self._file, "")
        return None if isinstance(unchanged, Conversion) and made.text == unchanged.text else made.text

    @property
    def settles(self) -> bool:
        """Whether the passes leave alone what they made."""
        if isinstance(self._outcome, CompileError):
            return True
        again = self._run(self._outcome.text.encode(), self.pipeline)
        return isinstance(again, Conversion) and again.text == self._outcome.text

    @property
    def _file(self) -> Path:
        return Path(self.path.name)

    @cached_property
    def _outcome(self) -> Conversion | CompileError:
        return self._run(self._file, self.pipeline)

    def _run(self, source: Path | bytes, pipeline: str) -> Conversion | CompileError:
        with chdir(self.path.parent):
            try:
                return convert(
                    source, to=_FORMATS[self.path.suffix], passes=pipeline, strict=self.strict, comments=False
                )
            except CompileError as error:
                return error


def pass_cases(folder: Path) -> list[PassCase]:
    """Every case of a folder and those below it, in the order of their names, without parts and expected outputs."""
    return [PassCase(case.path) for case in cases(folder)]
