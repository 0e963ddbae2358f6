"""A repository as a team has it: public models from the corpus, a configuration, a baseline, suppressions, and hooks.

`python -m tests.corpus.repository FOLDER` builds it, to try it with pre-commit itself.
"""

import shlex
import shutil
import sys
from contextlib import chdir
from pathlib import Path
from typing import Any, cast

import yaml
from click.testing import CliRunner, Result

from testbed.corpus.files import CORPUS
from tests.write_files import write_files
from twinform.cli import main

_HOOKS = Path(__file__).parents[2] / ".pre-commit-hooks.yaml"
PUBLIC = "ROBOTIS-GIT+turtlebot3_simulations"
WORLD = Path("turtlebot3/turtlebot3_gazebo/worlds/turtlebot3_autorace_2020.world")
HOUSE = Path("turtlebot3/turtlebot3_gazebo/worlds/turtlebot3_house.world")

_CONFIGURATION = """\
deny = ["missing-file", "indefinite-inertia", "outside-version"]
extend-exclude = ["turtlebot3/**/turtlebot3_dqn_world/"]
baseline = "known/twinform.json"

[[files]]
match = ["robots/*.xacro"]
arguments = { side = "left" }
check-passes = "check-limits"
strict = true

[[files]]
match = ["*.world"]
allow = ["unknown-element"]
"""
_ARM = """\
<?xml version="1.0"?>
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="arm">
  <xacro:arg name="side" default="right"/>
  <xacro:include filename="parts.xacro"/>
  <link name="base"/>
  <xacro:tool side="$(arg side)"/>
</robot>
"""
_PARTS = """\
<?xml version="1.0"?>
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="tool" params="side">
    <link name="${side}_tool"/>
    <joint name="${side}_mount" type="fixed">
      <parent link="base"/>
      <child link="${side}_tool"/>
    </joint>
  </xacro:macro>
</robot>
"""


def build(corpus: Path, folder: Path) -> None:
    """Make the repository in a folder that is empty."""
    shutil.copytree(corpus / PUBLIC, folder / "turtlebot3")
    files = {"twinform.toml": _CONFIGURATION, "robots/arm.urdf.xacro": _ARM, "robots/parts.xacro": _PARTS}
    files |= {".gitignore": "/scratch/\n", "scratch/broken.urdf": "<robot", "build/broken.urdf": "<robot"}
    write_files(folder, files)
    (folder / "known").mkdir()
    (folder / ".git/info").mkdir(parents=True, exist_ok=True)
    suppress(folder / WORLD, "the inertia of link 'Wall_3'", "allow indefinite-inertia - walls do not move", folder)
    _prepend(folder / HOUSE, "allow-file outside-version - frames are as SDF 1.6 has them")


def suppress(file: Path, message: str, words: str, folder: Path) -> None:
    """Put a comment before the element that a finding of a file is about."""
    found = run(folder, "check", str(file.relative_to(folder)), "--no-config")
    line = next(each for each in found.stdout.splitlines() if message in each)
    number = int(line.split(":")[1])
    lines = file.read_text().splitlines(keepends=True)
    lines.insert(number - 1, f"<!-- twinform: {words} -->\n")
    file.write_text("".join(lines))


def _prepend(file: Path, words: str) -> None:
    text = file.read_text()
    start = text.index("<sdf")
    file.write_text(f"{text[:start]}<!-- twinform: {words} -->\n{text[start:]}")


def run(folder: Path, *arguments: str) -> Result:
    """Run the command line in a folder."""
    with chdir(folder):
        return CliRunner().invoke(main, arguments, catch_exceptions=False)


def hook(identity: str) -> list[str]:
    """The words of a hook behind the name of the program, with its usual arguments."""
    hooks = cast("list[dict[str, Any]]", yaml.safe_load(_HOOKS.read_text()))
    (found,) = (each for each in hooks if each["id"] == identity)
    program, *words = shlex.split(found["entry"])
    assert program == "twinform"
    return [*words, *found.get("args", ())]


if __name__ == "__main__":
    build(CORPUS, Path(sys.argv[1]))
