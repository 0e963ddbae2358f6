from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from twinform.cli import main

Run = Callable[..., Result]

GOOD = """\
<robot name="one">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
</robot>
"""
WARNED = '<robot name="one">\n  <link name="base"><color/></link>\n</robot>\n'
WRONG = '<robot name="one">\n  <link name="a"/>\n  <joint name="b" type="fixed"><parent link="a"/></joint>\n</robot>\n'
BROKEN = '<robot name="one">\n  <link name="base">\n</robot>\n'


@pytest.fixture
def run() -> Run:
    """Run the command line; an exception that is no exit fails the test."""

    def invoke(*arguments: str | Path, text: str | bytes | None = None) -> Result:
        return CliRunner().invoke(main, [str(each) for each in arguments], input=text, catch_exceptions=False)

    return invoke


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a file for every ending of a run."""
    for name, text in {"good": GOOD, "warned": WARNED, "wrong": WRONG, "broken": BROKEN}.items():
        (tmp_path / f"{name}.urdf").write_text(text)
    return tmp_path


@pytest.fixture
def here(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder with the files, as the current one."""
    monkeypatch.chdir(folder)
    return folder
