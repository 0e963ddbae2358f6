"""The how-to pages and tutorials: every command in them runs, and prints what they say."""

import re
import shlex
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main

_ROOT = Path(__file__).parents[1]
_PAGES = [*sorted((_ROOT / "docs/how-to").glob("*.md")), *sorted((_ROOT / "docs/tutorial").glob("*.md"))]
_BLOCK = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)
_ERROR = re.compile(r"(^Error| error): ")
"""What a command prints that is meant to fail; `diff` ends with 1 to tell files apart."""


@pytest.mark.parametrize("page", _PAGES, ids=lambda page: page.stem)
def test_the_commands_of_a_page_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(_ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    steps = [
        step for block in _BLOCK.findall(page.read_text()) for step in re.split(r"^\$ ", block, flags=re.MULTILINE)
    ]
    for command, *expected in (step.splitlines() for step in steps if step):
        done = CliRunner().invoke(main, shlex.split(command)[1:], catch_exceptions=False)
        fails = command.startswith("twinform diff") or any(_ERROR.search(line) for line in expected)
        assert done.exit_code == 0 or fails, done.output
        assert all(line in done.output for line in expected), done.output
