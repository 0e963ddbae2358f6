"""The cases of `twinform sync`: folders with a `source` and a `file`, what the command says, and what it changes.

The outcome is the first word of a folder's name. The expected text has the report of `--check`, and the difference in
the text of each file that `--diff` prints. A folder without `file` is one where `file.sdf` is to be made.
"""

import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from tests.expected import assert_expected
from twinform.cli import main

_CASES = sorted(path for path in (Path(__file__).parent / "cases/sync").iterdir() if path.is_dir())
_CODES = {"current": {0}, "outdated": {1}, "refused": {1, 2}}


def _run(*words: str) -> Result:
    return CliRunner().invoke(main, ["sync", *words], catch_exceptions=False)


@pytest.mark.parametrize("case", _CASES, ids=lambda path: path.name)
def test_sync_says_and_changes_what_the_case_shows(case: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    folder = tmp_path / "case"
    shutil.copytree(case, folder)
    monkeypatch.chdir(folder)
    source = next(Path().glob("source.*")).name
    others = sorted(path.name for path in Path().glob("file*")) or ["file.sdf"]
    before = {name: Path(name).read_bytes() for name in others if Path(name).exists()}
    outcome = case.name.partition("_")[0]

    checked, shown = _run(source, *others, "--check"), _run(source, *others, "--diff")
    assert {checked.exit_code, shown.exit_code} <= _CODES[outcome], checked.output + shown.output
    assert before == {name: Path(name).read_bytes() for name in before}
    assert_expected(checked.stdout + checked.stderr + shown.stdout, case / "expected.txt")

    done = _run(source, *others)
    if outcome == "refused":
        assert done.exit_code in _CODES[outcome]
        assert before == {name: Path(name).read_bytes() for name in before}
        return
    assert done.exit_code == 0, done.output
    again = _run(source, *others, "--check")
    assert again.exit_code == 0, again.output
    if outcome == "current":
        assert before == {name: Path(name).read_bytes() for name in before}
