"""The documents do what they say: commands are run, and Python is executed."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[1]
_PAGES = [_ROOT / "README.md", *sorted((_ROOT / "docs").glob("how-to/*.md"))]
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def _blocks(page: Path, language: str) -> list[str]:
    return [text for found, text in _BLOCK.findall(page.read_text(encoding="utf-8")) if found == language]


def _commands(text: str) -> list[tuple[str, list[str]]]:
    """Each command with the lines that it prints."""
    found: list[tuple[str, list[str]]] = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        elif found:
            found[-1][1].append(line)
    return found


@pytest.mark.parametrize("page", [page for page in _PAGES if _blocks(page, "console")], ids=lambda page: page.name)
def test_commands_print_what_is_shown(page: Path) -> None:
    (_ROOT / "out").mkdir(exist_ok=True)
    for block in _blocks(page, "console"):
        for command, shown in _commands(block):
            program, *arguments = shlex.split(command)
            assert program == "twinform"
            run = [sys.executable, "-c", "from twinform.cli import main; main()", *arguments]
            done = subprocess.run(run, cwd=_ROOT, capture_output=True, text=True, check=False)
            printed = (done.stdout + done.stderr).splitlines()
            if shown:
                assert printed == shown, command
            assert done.returncode < 2, command


@pytest.mark.parametrize("page", [page for page in _PAGES if _blocks(page, "python")], ids=lambda page: page.name)
def test_python_runs(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(_ROOT)
    exec("\n".join(_blocks(page, "python")), {"__name__": page.stem})
