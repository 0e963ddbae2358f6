"""Cases of passes: a model file that says which pipeline runs over it, and what this finds.

The comment `<!-- passes: PIPELINE -->` is what `--passes` is given; `<!-- expect: severity rule -->` stands on the line
of a finding. Only findings of the rules about changes of structure are looked at, and of these all. Beside `NAME.urdf`
lies `NAME.expected.urdf`, unless there is an error.
"""

import os
import re
from collections import Counter
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import twinform
from twinform.diagnostics import Diagnostic, Rule
from twinform.diagnostics.rules import edits
from twinform.testing import Case, cases
from twinform.testing.case_files import Finding

FOLDER = Path(__file__).parent / "cases" / "structure"
_PASSES = re.compile(r"<!--\s*passes:\s*(.*?)\s*-->")
RULES = frozenset(rule.name for rule in vars(edits).values() if isinstance(rule, Rule))


@dataclass(frozen=True, slots=True)
class Ran:
    """What became of a case; no text after an error."""

    text: str
    diagnostics: tuple[Diagnostic, ...]

    @property
    def found(self) -> Counter[Finding]:
        """The findings that a case announces."""
        return Counter(
            (each.location.line, str(each.severity), each.rule.name)
            for each in self.diagnostics
            if each.rule.name in RULES
        )


def structure_cases() -> list[Case]:
    """Every case of the folder; files in folders below are parts of cases."""
    return cases(FOLDER, below=False)


def ran(case: Case) -> Ran:
    """Run the pipeline of a case; the files that it names are beside it."""
    found = _PASSES.search(case.path.read_text(encoding="utf-8"))
    assert found is not None, "the case names no pipeline"
    to = "urdf" if case.path.suffix == ".urdf" else "sdf"
    with _inside(FOLDER):
        try:
            made = twinform.convert(case.path, to=to, passes=found[1])
        except twinform.CompileError as error:
            return Ran("", error.diagnostics)
    return Ran(made.text, made.diagnostics)


@contextmanager
def _inside(folder: Path) -> Generator[None]:
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
