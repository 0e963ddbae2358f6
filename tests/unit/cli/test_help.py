"""Every command has examples in its help, and they can be typed."""

import contextlib
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

import twinform
from twinform.cli import main
from twinform.cli.command import Command

from .conftest import GOOD, Run

pytestmark = pytest.mark.slow

_XACRO = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="prefix" default=""/><link name="$(arg prefix)base"/>
</robot>
"""
_USD = """#usda 1.0
def Xform "arm" (prepend apiSchemas = ["PhysicsArticulationRootAPI"]) {
  def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {}
}
"""
_CONFIG = '<model><name>crate</name><sdf version="1.11">model.sdf</sdf></model>'
_NOT_RUN = {
    "lsp": "it waits for an editor",
    "mcp": "it waits for an agent",
    "reproduce": "it takes the file that a fault has left",
    "view": "it shows a robot until Ctrl-C",
}


def _commands(group: click.Group, above: tuple[str, ...] = ()) -> Iterator[tuple[str, click.Command]]:
    context = click.Context(group)
    for name in group.list_commands(context):
        found = group.get_command(context, name)
        assert found is not None
        if isinstance(found, click.Group):
            yield from _commands(found, (*above, name))
        else:
            yield " ".join((*above, name)), found


COMMANDS = dict(_commands(main))
EXAMPLES = [
    (name, example)
    for name, command in COMMANDS.items()
    if isinstance(command, Command) and name not in _NOT_RUN
    for example in command.examples.values()
]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_examples(run: Run, name: str) -> None:
    command = COMMANDS[name]
    assert isinstance(command, Command)
    shown = run(*name.split(), "--help").stdout
    assert command.examples
    for what, typed in command.examples.items():
        assert typed.startswith(f"twinform {name}")
        assert f"  {what}:\n    {typed}\n" in shown


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files that the examples name."""
    made = tmp_path_factory.mktemp("files")
    for name in ("robot.urdf", "models/a.urdf", "base.urdf", "ours.urdf", "theirs.urdf"):
        (made / name).parent.mkdir(exist_ok=True)
        (made / name).write_text(GOOD)
    (made / "arm.urdf.xacro").write_text(_XACRO)
    (made / "robot.usda").write_text(_USD)
    sdf = twinform.convert(GOOD.encode(), to="sdf").text
    (made / "robot.sdf").write_text(sdf)
    for crate in (made / "crate", made / "models/crate"):
        crate.mkdir()
        (crate / "model.config").write_text(_CONFIG)
        (crate / "model.sdf").write_text(sdf)
    if shutil.which("git"):
        subprocess.run(["git", "init", "--quiet"], cwd=made, check=True)
    (made / "out").mkdir()
    (made / "out" / "a.sdf").write_text(sdf)
    for part in range(1, 5):
        arguments = f"batch convert models out{part} --to sdf --jobs 1 --shard {part}/4".split()
        with contextlib.chdir(made):
            assert CliRunner().invoke(main, arguments).exit_code == 0
    return made


@pytest.fixture
def folder(files: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it, where the command runs."""
    shutil.copytree(files, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GZ_FUEL_CACHE_PATH", str(tmp_path / "fuel"))
    return tmp_path


@pytest.mark.parametrize(("name", "example"), EXAMPLES)
def test_the_examples_can_be_typed(folder: Path, run: Run, name: str, example: str) -> None:
    done = run(*shlex.split(example)[1:])
    assert done.exit_code in {0, 1}, (folder, name, done.output)
