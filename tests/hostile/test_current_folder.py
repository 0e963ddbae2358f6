"""Nothing of the current folder is run, whatever modules and programs lie there: it may have come with a model."""

import os
import sys
from collections.abc import Sequence
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from tests.profile import DEEP
from tests.write_files import write_files

from .every_command import FILES, INVOCATIONS, Printed, commands, run

_WITH_CHILDREN = {"batch stats", "lsp", "mcp", "view"}
"""Commands that start every kind of child process between them; the quick tests try only these."""
_BESIDES = ("sitecustomize", "twinform", "usercustomize")
_ENTRY_POINTS = "[twinform.passes]\nevil = evil:Evil\n[pydantic]\nevil = evil:Evil\n"


def _marker(folder: Path) -> Path:
    return folder.with_name(f"{folder.name}-ran")


def _poison(folder: Path) -> None:
    """Put modules, packages, plugins and programs of every name that may be looked for into a folder."""
    text = f"with open({str(_marker(folder))!r}, 'a') as file:\n    print(__name__, file=file)\n"
    for name in {*sys.stdlib_module_names, *packages_distributions(), *_BESIDES, "evil"}:
        (folder / f"{name}.py").write_text(text)
        (folder / name).mkdir(exist_ok=True)
        (folder / name / "__init__.py").write_text(text)
    for kind in ("dist-info", "egg-info"):
        (folder / f"evil-1.0.{kind}").mkdir()
        (folder / f"evil-1.0.{kind}" / "entry_points.txt").write_text(_ENTRY_POINTS)


_MAKERS = {"batch merge": "batch convert", "fuel list": "fuel add"}
"""Commands that need what another one makes."""


def _calls(command: str, folder: Path) -> Sequence[Printed]:
    commands = [_MAKERS[command], command] if command in _MAKERS else [command]
    return [run(call.split(), folder) for each in commands for call in INVOCATIONS[each]]


def test_every_command_is_tried() -> None:
    assert set(commands()) == set(INVOCATIONS)


@pytest.mark.parametrize(
    "command", [each if each in _WITH_CHILDREN else pytest.param(each, marks=pytest.mark.deep) for each in INVOCATIONS]
)
def test_a_command_runs_no_module_of_the_current_folder(command: str, tmp_path: Path) -> None:
    clean, poisoned = tmp_path / "clean" / "here", tmp_path / "poisoned" / "here"
    for folder in (clean, poisoned):
        write_files(folder, FILES)
    _poison(poisoned)
    found = _calls(command, poisoned)
    assert not _marker(poisoned).exists(), _marker(poisoned).read_text()
    if DEEP:
        assert found == _calls(command, clean)
    assert all(each.code in {0, 1} for each in found), found


def test_an_empty_entry_of_a_search_path_is_not_the_current_folder(tmp_path: Path) -> None:
    # what Python imports before the program begins cannot be helped, so there is no module of Python's own here
    folder = tmp_path / "here"
    write_files(folder, FILES)
    text = f"open({str(_marker(folder))!r}, 'a').close()"
    for name in ("lxml", "pebble", "pydantic"):
        (folder / f"{name}.py").write_text(text)
    program = folder / "xdg-open"
    program.write_text(f"#!/bin/sh\ntouch {_marker(folder)}\n")
    program.chmod(0o755)
    environment = {"PYTHONPATH": f"{os.pathsep}/nowhere", "PATH": f".{os.pathsep}", "DISPLAY": ":9"}
    for call in ("batch stats models --jobs 1", "view cube.urdf"):
        assert run(call.split(), folder, environment).code == 0
    assert not _marker(folder).exists()
