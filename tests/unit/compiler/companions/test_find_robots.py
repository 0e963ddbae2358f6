"""Which robot a companion file is for, and what is not read to find that out."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from twinform.compiler.companions.find_robots import Candidates, find_robots
from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.resolve_uris import SearchPath

_SRDF = b'<robot name="arm"/>'
_YAML = b"joint_limits:\n  hip: {max_velocity: 1}\n"


def _robot(path: Path, name: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<robot name="{name}"><link name="base"/></robot>', encoding="utf-8")
    return path


def _package(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(f"<package><name>{folder.name}</name></package>", encoding="utf-8")
    return folder


def _found(path: Path, data: bytes = _YAML, **options: str) -> Candidates:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return find_robots(path, data, replace(LoadOptions(search=SearchPath.of()), **options))


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    (tmp_path / ".git").mkdir()
    for name in ("arm", "leg"):
        _robot(_package(tmp_path / f"{name}_description") / f"urdf/{name}.urdf", name)
    _package(tmp_path / "arm_moveit_config")
    _package(tmp_path / "tools")
    return tmp_path


def test_what_says_it_first_decides(workspace: Path) -> None:
    arm, leg = (workspace / f"{name}_description/urdf/{name}.urdf" for name in ("arm", "leg"))
    config = workspace / "arm_moveit_config"
    limits = config / "config/joint_limits.yaml"
    assert _found(limits) == ((arm,), "package")
    assert _found(workspace / "tools/limits.yaml") == ((arm, leg), "place")
    assert _found(workspace / "tools/any.srdf", _SRDF) == ((arm,), "name")
    launch = workspace / "tools/launch/all.launch.py"
    launch.parent.mkdir()
    launch.write_text("load('leg.urdf', 'limits.yaml')", encoding="utf-8")
    assert _found(workspace / "tools/limits.yaml") == ((leg,), "name")
    assistant = "x:\n  URDF:\n    package: leg_description\n    relative_path: urdf/leg.urdf\n"
    (config / ".setup_assistant").write_text(assistant, encoding="utf-8")
    assert _found(limits) == ((leg,), "name")
    own = _robot(config / "config/own.urdf", "own")
    assert _found(limits) == ((own,), "package")
    assert _found(config / "config/arm.srdf", _SRDF) == ((arm,), "name")
    assert _found(limits, robot=str(leg)) == ((leg,), "name")


def test_packages_of_a_workspace_without_a_repository_lie_beside_each_other(workspace: Path) -> None:
    (workspace / ".git").rmdir()
    robots, by = _found(workspace / "arm_moveit_config/config/joint_limits.yaml")
    assert ([each.name for each in robots], by) == (["arm.urdf"], "package")


def test_parts_and_hidden_or_built_files_are_no_robots(workspace: Path) -> None:
    for place in ("build/arm.urdf", ".cache/arm.urdf", "arm_description/install/arm.urdf"):
        _robot(workspace / place, "arm")
    macros = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m"/></robot>'
    (workspace / "arm_description/urdf/macros.xacro").write_text(macros, encoding="utf-8")
    assert len(_found(workspace / "arm_moveit_config/config/joint_limits.yaml").robots) == 1


@pytest.mark.parametrize("place", ["../../secret.urdf", "/etc/passwd", "urdf/none.urdf", "urdf", "[a", "urdf/\\0"])
def test_a_setup_assistant_leads_into_packages_only(workspace: Path, place: str) -> None:
    _robot(workspace.parent / "secret.urdf", "secret")
    text = f'x:\n  URDF: {{package: leg_description, relative_path: "{place}"}}\n'
    config = workspace / "arm_moveit_config"
    (config / ".setup_assistant").write_text(text, encoding="utf-8")
    assert [each.name for each in _found(config / "joint_limits.yaml").robots] == ["arm.urdf"]


def test_a_setup_assistant_is_no_link_and_no_pipe(workspace: Path) -> None:
    config = workspace / "arm_moveit_config"
    assistant = config / ".setup_assistant"
    secret = workspace.parent / "secret.yaml"
    secret.write_text("x:\n  URDF: {package: leg_description, relative_path: urdf/leg.urdf}\n", encoding="utf-8")
    assistant.symlink_to(secret)
    assert [each.name for each in _found(config / "joint_limits.yaml").robots] == ["arm.urdf"]
    assistant.unlink()
    os.mkfifo(assistant)
    assert [each.name for each in _found(config / "joint_limits.yaml").robots] == ["arm.urdf"]
