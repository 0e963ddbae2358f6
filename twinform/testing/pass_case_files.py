"""Cases of passes as data: a model that says itself which pipeline runs over it and what that finds.

A comment `<!-- passes: PIPELINE -->` names the passes; what `cases.py` says of `expect` holds here for what they report
and what is found in the source. Beside `NAME.urdf` lies `NAME.expected.urdf`, and beside `NAME.sdf`
`NAME.expected.sdf`: the file after the passes. Where they change nothing there is none.
"""

import re
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

from twinform.compiler import CompileError, Conversion, convert
from twinform.diagnostics import Diagnostic
from twinform.testing.case_files import Case, Finding, cases

_PASSES = re.compile(r"<!--\s*passes:\s*(?P<pipeline>.*?)\s*-->", re.DOTALL)
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
        return found["pipeline"]

    @cached_property
    def _made(self) -> tuple[Conversion | None, tuple[Diagnostic, ...]]:
        try:
            made = self._converted(self.pipeline)
        except CompileError as error:
            return None, error.diagnostics
        return made, made.diagnostics

    def _converted(self, pipeline: str) -> Conversion:
        return convert(self.path, to=_FORMATS[self.path.suffix], passes=pipeline, strict=self.strict)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All that was found."""
        return self._made[1]

    @property
    def found(self) -> Counter[Finding]:
        """What the compiler and the passes report."""
        return Counter((each.location.line, str(each.severity), each.rule.name) for each in self.diagnostics)

    @property
    def output_path(self) -> Path:
        """Where the expected output lies, if there is one."""
        return self.path.with_suffix(f".expected{self.path.suffix}")

    @property
    def changes(self) -> bool:
        """Whether the passes change the document."""
        made = self._made[0]
        try:
            return made is None or made.text != self._converted("").text
        except CompileError:
            return True  # what was wrong with it they have put right

    @property
    def text(self) -> str:
        """The file after the passes; the errors where it does not become anything."""
        made, found = self._made
        return made.text if made else "\n".join(f"{each.location.line}: {each.rule.name}" for each in found)


def pass_cases(folder: Path) -> list[PassCase]:
    """Every case of a folder and those below it, in the order of their names; expected outputs are not cases."""
    return [PassCase(case.path) for case in cases(folder)]
