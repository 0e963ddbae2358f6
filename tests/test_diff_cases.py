"""The cases of comparisons: folders with two files, `a` and `b`, and what `twinform diff` prints about them."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from tests.expected import assert_expected
from twinform.cli import main

_CASES = sorted(path for path in (Path(__file__).parent / "cases/diff").iterdir() if path.is_dir())
_CODES = {"same": 0, "different": 1, "carried": 1}
"""The verdict is the first word of a folder's name; what is carried is the same for those who read carriers."""


@pytest.mark.parametrize("case", _CASES, ids=lambda path: path.name)
def test_diff_prints_what_the_case_shows(case: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(case)
    a, b = (next(Path().glob(f"{side}.*")).name for side in "ab")
    if b.endswith(".usda"):
        pytest.importorskip("pxr", reason="usd-core is not installed")
    done = CliRunner().invoke(main, ["diff", a, b], catch_exceptions=False)
    assert done.exit_code == _CODES[case.name.partition("_")[0]], done.output
    assert_expected(done.output, Path("expected.txt"))
    back = CliRunner().invoke(main, ["diff", b, a], catch_exceptions=False)
    assert back.exit_code == done.exit_code
    carried = CliRunner().invoke(main, ["diff", a, b, "--carriers"], catch_exceptions=False)
    assert carried.exit_code == (1 if case.name.startswith("different_") else 0), carried.output
