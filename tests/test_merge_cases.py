"""The cases of merges: folders with `base`, `ours` and `theirs`, what `twinform merge` makes of them, and says."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from tests.expected import assert_expected
from twinform.cli import main

_CASES = sorted(path for path in (Path(__file__).parent / "cases/merge").iterdir() if path.is_dir())
_CODES = {"merged": 0, "conflict": 1}
"""The outcome is the first word of a folder's name."""


@pytest.mark.parametrize("case", _CASES, ids=lambda path: path.name)
def test_merge_makes_what_the_case_shows(case: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(case)
    names = [next(Path().glob(f"{side}.*")).name for side in ("base", "ours", "theirs")]
    done = CliRunner().invoke(main, ["merge", *names], catch_exceptions=False)
    assert done.exit_code == _CODES[case.name.partition("_")[0]], done.output
    assert ("\n<<<<<<< ours\n" in done.stdout) == (done.exit_code == 1)
    assert_expected(done.stdout + done.stderr, Path("expected.txt"))
