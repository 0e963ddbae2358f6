"""The documents do what they say: files are written, commands run and Python executed, in the order of the page.

What needs a program, a machine or a network that is not here is at least read: its commands and options exist.
"""

import doctest
import json
import re
import shlex
import shutil
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import click
import pytest
import yaml
from click.testing import CliRunner
from lxml import etree

from twinform.cli import main

pytestmark = pytest.mark.slow

_ROOT = Path(__file__).parents[1]
_PAGES = [
    *(_ROOT / name for name in ("README.md", "CONTRIBUTING.md", "ARCHITECTURE.md")),
    *sorted((_ROOT / "docs").rglob("*.md")),
]
_ERROR = re.compile(r"(^Error| error): ")
"""What a command prints that is meant to fail; `diff` and `--diff` end with 1 where there is a difference."""
_FENCE = re.compile(r'^```(?:(\w+)(?: title="([^"]+)")?)?\n(.*?)^```$', re.MULTILINE | re.DOTALL)
_INDENTED = re.compile(r"(?:\A|\n)\n(?: {4}|\t)\S")
_ELSE = "..."
"""Stands for what a command prints and the page leaves out."""
_DONE = {"console", "python"}
_READ = {"cmake", "json", "pycon", "sh", "toml", "xml", "yaml", "csv", "text"}


class Block(NamedTuple):
    """A block of code of a page; one with a title is the file of that name."""

    language: str
    title: str
    text: str


def _all_blocks(page: Path) -> list[Block]:
    return [Block(*found) for found in _FENCE.findall(page.read_text(encoding="utf-8"))]


def _blocks(page: Path, language: str) -> list[str]:
    return [block.text for block in _all_blocks(page) if block.language == language]


def _id(page: Path) -> str:
    return page.relative_to(_ROOT).as_posix()


def _with(language: str, *, but: frozenset[str] = frozenset()) -> list[Path]:
    return [page for page in _PAGES if _blocks(page, language) and page.name not in but]


def _commands(text: str) -> list[tuple[str, list[str]]]:
    """Each command with the lines that it prints."""
    found: list[tuple[str, list[str]]] = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        elif found:
            found[-1][1].append(line)
    return found


def _abridged(printed: list[str], shown: list[str]) -> list[str]:
    """What is printed, with `...` for what is not shown there."""
    found: list[str] = []
    for line, after in pairwise((*shown, None)):
        if line != _ELSE:
            found += printed[:1]
            printed = printed[1:]
            continue
        end = len(printed) if after is None else printed.index(after) if after in printed else 0
        assert end, "there is nothing to leave out"
        found.append(_ELSE)
        printed = printed[end:]
    return [*found, *printed]


def _stand_in(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let what follows find the examples and tests here, and leave its files here, as in a clone that is new."""
    shutil.copytree(_ROOT / "examples", folder / "examples")
    (folder / "tests").symlink_to(_ROOT / "tests")
    monkeypatch.chdir(folder)


def _run(text: str) -> None:
    """Run the commands of a block, each of which prints what is shown."""
    for command, shown in _commands(text):
        program, *arguments = shlex.split(command)
        assert program == "twinform"
        done = CliRunner().invoke(main, arguments, catch_exceptions=False)
        printed = (done.stdout + done.stderr).splitlines()
        assert _abridged(printed, shown) == shown, command
        fails = {"diff", "--diff"} & {*arguments} or any(_ERROR.search(line) for line in printed)
        assert done.exit_code == 0 or fails, command


_DOING = [page for page in _PAGES if any(block.language in _DONE for block in _all_blocks(page))]


@pytest.mark.parametrize("page", _DOING, ids=_id)
def test_a_page_does_what_it_shows(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _stand_in(tmp_path, monkeypatch)
    names: dict[str, object] = {"__name__": page.stem}
    for block in _all_blocks(page):
        if block.title:
            Path(block.title).parent.mkdir(parents=True, exist_ok=True)
            Path(block.title).write_text(block.text, encoding="utf-8")
        if block.language == "console":
            _run(block.text)
        if block.language == "python":
            exec(block.text, names)


@pytest.mark.parametrize("page", _with("pycon"), ids=_id)
def test_what_python_is_shown_to_print_is_what_it_prints(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _stand_in(tmp_path, monkeypatch)
    result = doctest.testfile(str(page), module_relative=False)
    assert result.attempted >= 1
    assert result.failed == 0


@pytest.mark.parametrize("page", _PAGES, ids=_id)
def test_no_block_is_left_unread(page: Path) -> None:
    """Every block has a language that a test knows, and code is never only indented."""
    assert {block.language for block in _all_blocks(page)} <= _DONE | _READ
    if page.parent.name == "evidence":
        return  # reports write these, and indent what they were given
    outside = _FENCE.sub("", page.read_text(encoding="utf-8"))
    assert not re.search(r"^ *```", outside, re.MULTILINE)
    assert not _INDENTED.search(re.sub(r"(?m)^(?:[*-]|\d+\.) (?:.|\n(?!\S))*", "", outside))


def _lines_of_shells() -> Iterator[tuple[Path, str]]:
    for page in _PAGES:
        yield from ((page, text) for text in _blocks(page, "sh"))
        for text in _blocks(page, "yaml"):
            yield from ((page, line) for line in re.findall(r"(?:run:|^ +-) (.*)", text, re.MULTILINE))


def _nothing(*_: object) -> None:
    """Instead of running a command."""


def test_commands_that_are_not_run_are_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They need what is not here, such as a browser, ROS or another machine; the options are those that there are."""
    monkeypatch.setattr(click.Command, "invoke", _nothing)
    monkeypatch.chdir(tmp_path)
    for folder in ("crate", "models"):  # which examples name
        Path(folder).mkdir()
    seen = 0
    for page, text in _lines_of_shells():
        for line in re.findall(r"^(?:[\w./]*/)?twinform .*$", text, re.MULTILINE):
            _, *arguments = shlex.split(re.sub(r" +(?:#|&&|\|\||\|).*", "", line))
            done = CliRunner().invoke(main, arguments)
            assert done.exit_code == 0, f"{page.name}: {line}: {done.output}"
            seen += 1
    assert seen >= 10


@pytest.mark.parametrize("page", _with("yaml"), ids=_id)
def test_yaml_is_well_formed(page: Path) -> None:
    for block in _blocks(page, "yaml"):
        assert yaml.safe_load(block)


_OF_OTHERS = frozenset({"write-a-pass.md", "property-test-a-pass.md"})
"""Pages with settings that are not those of twinform."""


@pytest.mark.parametrize("page", _with("toml", but=_OF_OTHERS), ids=_id)
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
