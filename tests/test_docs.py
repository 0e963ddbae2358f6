"""The documents do what they say: commands are run, and Python is executed."""

import json
import re
import shlex
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from lxml import etree

from twinform.cli import main

_ROOT = Path(__file__).parents[1]
_PAGES = [_ROOT / "README.md", *sorted((_ROOT / "docs").rglob("*.md"))]
_ERROR = re.compile(r"(^Error| error): ")
"""What a command prints that is meant to fail; `diff` and `--diff` end with 1 where there is a difference."""
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


def _stand_in(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let what follows find the examples and tests here, and leave its files here, as in a clone that is new."""
    shutil.copytree(_ROOT / "examples", folder / "examples")
    (folder / "tests").symlink_to(_ROOT / "tests")
    monkeypatch.chdir(folder)


@pytest.mark.parametrize("page", [page for page in _PAGES if _blocks(page, "console")], ids=lambda page: page.name)
def test_commands_print_what_is_shown(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _stand_in(tmp_path, monkeypatch)
    for block in _blocks(page, "console"):
        for command, shown in _commands(block):
            program, *arguments = shlex.split(command)
            assert program == "twinform"
            done = CliRunner().invoke(main, arguments, catch_exceptions=False)
            printed = (done.stdout + done.stderr).splitlines()
            if page.parent.name == "tutorial":  # which shows what matters
                printed = [line for line in printed if line in shown]
            if shown:
                assert printed == shown, command
            fails = "diff" in arguments[0] or "--diff" in arguments or any(_ERROR.search(line) for line in shown)
            assert done.exit_code == 0 or fails, command


@pytest.mark.parametrize("page", [page for page in _PAGES if _blocks(page, "python")], ids=lambda page: page.name)
def test_python_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _stand_in(tmp_path, monkeypatch)
    exec("\n".join(_blocks(page, "python")), {"__name__": page.stem})


_OF_OTHERS = {"write-a-pass.md", "property-test-a-pass.md"}
"""Pages with settings that are not those of twinform."""
_SETTINGS = [page for page in _PAGES if _blocks(page, "toml") and page.name not in _OF_OTHERS]


@pytest.mark.parametrize("page", _SETTINGS, ids=lambda page: page.name)
def test_settings_are_understood(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _stand_in(tmp_path, monkeypatch)
    for folder in ("models", "meshes"):
        Path(folder).mkdir()
    for block in _blocks(page, "toml"):
        Path("twinform.toml").write_text(block, encoding="utf-8")
        done = CliRunner().invoke(main, ["convert", "examples/rover.urdf", "--to", "sdf"], catch_exceptions=False)
        assert done.exit_code == 0, done.stderr


@pytest.mark.parametrize(("language", "parse"), [("json", json.loads), ("xml", etree.fromstring)])
def test_what_is_shown_is_well_formed(language: str, parse: Callable[[str], object]) -> None:
    for page in _PAGES:
        for block in _blocks(page, language):
            parse(f"<robot>{block}</robot>" if language == "xml" else block)
