"""The cases of `--split`: worlds, what is reported when they are taken apart, and the files that they become."""

import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from testbed.worlds import Loaded, Together, judge
from tests.expected import assert_expected
from twinform.cli import main

_FOLDER = Path(__file__).parent / "cases/split"
_CASES = sorted(path for path in _FOLDER.iterdir() if path.suffix in {".sdf", ".world"})


@pytest.mark.parametrize("case", _CASES, ids=lambda path: path.stem)
def test_split_writes_what_the_case_shows(case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(shutil.copytree(_FOLDER, tmp_path / "source"))
    done = CliRunner().invoke(
        main, ["convert", case.name, "--to", "urdf", "--split", "-o", "../out"], catch_exceptions=False
    )
    assert done.exit_code == 0, done.output
    files = "".join(f"==> {path.name}\n{path.read_text()}" for path in sorted((tmp_path / "out").iterdir()))
    assert_expected(done.stderr + files, case.with_name(f"{case.stem}.expected.txt"))


@pytest.mark.parametrize("case", _CASES, ids=lambda path: path.stem)
def test_put_together_it_is_the_same_world(case: Path, tmp_path: Path):
    found = judge(case.name, case, (), tmp_path / "out")
    assert found is not None
    assert (found.together, found.cause) == (Together.SAME, "")
    assert found.loaded in {Loaded.SAME, Loaded.UNASKED}
