"""The case files of fixes: what `check --fix` makes of them.

A comment with `fixes: safe` or `fixes: unsafe` says which fixes are applied, and `passes: PIPELINE` which passes look
for findings too. Beside `NAME.urdf` lies `NAME.expected.urdf`.
"""

import re
from pathlib import Path

import pytest

from testbed.fixed_files import fixed_file
from tests.expected import assert_expected
from twinform.compiler import LoadOptions, LoadResult, inspect, read
from twinform.compiler.fixing import FixResult, apply_fixes_by, with_fixes
from twinform.diagnostics import Safety, catalog
from twinform.passes import Pipeline, parse_pipeline

_CASES = Path(__file__).parent / "cases"
FIXES = [path for path in sorted((_CASES / "fix").glob("*.*df")) if ".expected" not in path.name]
_CHECKS = sorted(path for path in (_CASES / "check").iterdir() if path.suffix in {".sdf", ".urdf"})
_PASSES = re.compile(r"passes: ([\w{}=,-]+)")


def passes_of(data: bytes) -> Pipeline | None:
    """Return the passes that a case names."""
    passes = _PASSES.search(data.decode())
    return parse_pipeline(passes[1]) if passes else None


def _look(path: Path, data: bytes) -> LoadResult:
    load_options = LoadOptions()
    return inspect(read(data, load_options, name=str(path)), load_options, passes_of(data))


def fixed(path: Path) -> FixResult:
    """Fix a case as it says."""
    data = path.read_bytes()
    return apply_fixes_by(lambda texts: _look(path, texts[""]), data, unsafe=b"fixes: unsafe" in data)


def _name(path: Path) -> str:
    return path.name


@pytest.mark.parametrize("path", FIXES, ids=_name)
def test_fixes_make_what_the_case_shows(path: Path) -> None:
    assert_expected(fixed(path).data.decode(), path.with_suffix(f".expected{path.suffix}"))


@pytest.mark.parametrize("path", FIXES, ids=_name)
def test_nothing_is_left_to_fix_and_nothing_was_taken_back(path: Path) -> None:
    made = fixed(path)
    assert made.refused == ()
    assert [each for each in with_fixes(made.left) if each.fix and each.fix.safety is Safety.SAFE] == []


@pytest.mark.parametrize("path", [*FIXES, *_CHECKS], ids=_name)
def test_fixes_keep_their_promises(path: Path) -> None:
    assert fixed_file(str(path), path.read_bytes()).faults == ()


def test_every_rule_with_fixes_has_a_case() -> None:
    made = {each.rule.name for path in FIXES for each in fixed(path).applied}
    offered = {each.rule.name for path in _CHECKS for each in with_fixes(_look(path, path.read_bytes())) if each.fix}
    wanted = {name for name, rule in catalog().items() if rule.fix and rule.group != "xacro"}
    assert wanted - made - offered == set()
