"""An error or a signal at any call of any command that writes: all is old or all is new, and nothing else is left."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from testbed import robots
from tests.distributions import write_distribution
from tests.hostile.injected import CACHE, FAULTS
from tests.profile import DEEP

_INJECTED = Path(__file__).with_name("injected.py")
_EXAMPLES = Path(__file__).parents[2] / "examples"
_ROBOT = '<robot name="r">\n<link name="a"/>\n</robot>\n'
_WORLD = """<sdf version="1.11"><world name="w">
<model name="one"><link name="l"/></model><model name="two"><link name="l"/></model></world></sdf>"""
_WITH_MESH = """<robot name="m"><link name="a"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<collision><geometry><mesh filename="m.obj"/></geometry></collision></link></robot>"""
_MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
_FAILING = """from typing import ClassVar
from twinform.passes import Pass
class Fail(Pass):
    \"""Fail, always.\"""
    name: ClassVar[str] = "fail"
    example: ClassVar[str] = "fail"
    def run(self, document, sink):
        raise LookupError("it has no parts")
"""


class Command(NamedTuple):
    """A command as it is typed, what is done before it, whether it writes each file for itself, and its exit code."""

    words: str
    first: Sequence[str] = ()
    apart: bool = False
    code: int = 0


COMMANDS = {
    "a conversion": Command("convert r.urdf -o r.sdf"),
    "one over a file": Command("convert r.urdf -o old.sdf"),
    "one to standard output": Command("convert r.urdf"),
    "one in a new folder": Command("convert r.urdf -o new/inner/r.sdf"),
    "several": Command("convert r.urdf two.urdf --to sdf -o out", ("convert r.urdf -o out/r.sdf",)),
    "all files of one": Command(
        "convert r.urdf -o old.sdf --ledger l/ledger.json --world world.sdf --bridge bridge.yaml"
    ),
    "a file of a pass": Command("convert r.urdf -o old.sdf --passes bridge-config{file=b.yaml}"),
    "one in place": Command("convert r.urdf two.urdf --in-place --passes prefix-names{prefix=x_}"),
    "one into a file": Command(
        "convert r.sdf --into r.urdf",
        ("convert r.urdf -o r.sdf", "fix r.sdf --passes set-surface{mu=0.5}"),
    ),
    "a split": Command("convert w.sdf --split -o out"),
    "a dump": Command("convert r.urdf -o r.sdf --dump-ir-after urdf-joints"),
    "xacro": Command("convert x.urdf.xacro -o x.sdf"),
    "check --fix": Command("check odd.urdf worse.urdf --fix", apart=True),
    "fix": Command("fix odd.urdf worse.urdf"),
    "format": Command("format bad.urdf worse.urdf", apart=True),
    "a baseline": Command("check bad.urdf odd.urdf --baseline b.json --update-baseline"),
    "a baseline again": Command(
        "check bad.urdf --baseline b.json --update-baseline",
        ("check bad.urdf odd.urdf --baseline b.json --update-baseline", "fix odd.urdf"),
    ),
    "a model folder": Command("package r.urdf -o pack/robot --kind gazebo-model --no-thumbnail --ledger l.json"),
    "a model folder again": Command(
        "package two.urdf -o robot --kind gazebo-model --no-thumbnail --sdf-version 1.9",
        ("package r.urdf -o robot --kind gazebo-model --no-thumbnail --sdf-version 1.11 --sdf-version 1.6",),
    ),
    "a thumbnail": Command("package r.urdf -o robot --kind gazebo-model"),
    "a ROS 2 package": Command("package r.urdf -o robot --kind ros2"),
    "both again": Command("package two.urdf -o robot --kind both", ("package r.urdf -o robot --kind ros2",)),
    "fuel add": Command("fuel add crate --owner Somebody --cache cache"),
    "a graph": Command("graph r.urdf -o r.svg"),
    "a report": Command("report r.urdf two.urdf -o old.html --no-view"),
    "a report with a view": Command("report r.urdf -o old.html"),
    "a reproducer": Command("convert r.urdf -o old.sdf --passes fail --reproducers found/here", code=1),
    "one more reproducer": Command(
        "convert r.urdf -o old.sdf --passes fail --reproducers found",
        ("convert r.urdf -o old.sdf --passes fail --reproducers found",),
        code=1,
    ),
    "what is reproduced": Command(
        "reproduce found/twinform-fail-r.json",
        ("convert r.urdf -o old.sdf --passes fail --reproducers found",),
        code=1,
    ),
    "meshes": Command(
        "convert m.urdf -o out/m.sdf --passes convert-meshes{to=stl}",
        ("convert m.urdf -o m.sdf --passes convert-meshes{to=stl}",),
    ),
    "a cache of meshes": Command("convert m.urdf -o out/m.sdf --passes convert-meshes{to=stl}", apart=True),
    "a schema": Command("schema urdf -o s.xsd"),
    "schemas": Command("schema urdf --xacro -o s.xsd"),
}


def _write_models(folder: Path) -> None:
    (folder / ".git").mkdir()
    (folder / "r.urdf").write_text(robots.urdf(2))
    (folder / "m.urdf").write_text(_WITH_MESH)
    (folder / "m.obj").write_text(_MESH)
    (folder / "two.urdf").write_text(_ROBOT)
    (folder / "w.sdf").write_text(_WORLD)
    (folder / "bad.urdf").write_text('<robot name="r">\n<link name="a"><visual/></link><link name="b"/></robot>')
    (folder / "worse.urdf").write_text('<?xml version="0.0"?><robot name="r"><link name="a" >\n\n</link></robot>')
    (folder / "odd.urdf").write_text('<?xml version="0.0"?><robot name="o"><link name="a"/></robot>')
    (folder / "x.urdf.xacro").write_text(_ROBOT.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'))
    for name in ("old.sdf", "old.html"):
        (folder / name).write_text("as it was")
    shutil.copytree(_EXAMPLES / "crate", folder / "crate")
    (folder / "plugin").mkdir()
    (folder / "plugin" / "failing.py").write_text(_FAILING)
    write_distribution(folder / "plugin", "failing", {"fail": "failing:Fail"})


def environment(template: Path) -> Mapping[str, str]:
    """What a command needs to know the pass that fails; meshes are kept in the folder where it runs."""
    path = os.pathsep.join([str(_EXAMPLES.parent), str(template / "plugin")])
    return {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1", "TWINFORM_MESH_CACHE": CACHE}


def prepare(command: Command, template: Path) -> None:
    """Put models into a folder, and do what is done before a command."""
    _write_models(template)
    for each in command.first:
        run = [sys.executable, "-P", "-m", "twinform", *each.split()]
        done = subprocess.run(run, cwd=template, check=False, capture_output=True, env=environment(template))
        assert done.returncode in {0, 1, command.code}, done.stderr


def injected(command: Command, template: Path, faults: Sequence[str], every: int) -> tuple[int, list[str]]:
    """How many runs there were, and what went wrong in them."""
    prepare(command, template)
    request = {"arguments": command.words.split(), "template": str(template), "faults": faults, "every": every}
    done = subprocess.run(
        [sys.executable, _INJECTED, json.dumps({**request, "apart": command.apart, "code": command.code})],
        capture_output=True,
        text=True,
        check=False,
        env=environment(template),
    )
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    return result["runs"], result["problems"]


_QUICK = {"format", "all files of one", "a model folder again"}
"""Commands that write in each of the three ways: a file, several, and a folder."""

_SLOW = {"a cache of meshes"}
"""Commands that start a process each time, which takes a second."""


@pytest.mark.parametrize(
    "name", [name if name in _QUICK else pytest.param(name, marks=pytest.mark.deep) for name in COMMANDS]
)
def test_a_fault_at_any_call_leaves_all_old_or_all_new(name: str, tmp_path: Path) -> None:
    faults, every = (FAULTS, 23 if name in _SLOW else 1) if DEEP else (["EIO", "SIGINT after", "KeyboardInterrupt"], 61)
    runs, problems = injected(COMMANDS[name], tmp_path, faults, every)
    assert problems == []
    assert runs
