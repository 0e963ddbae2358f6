"""What `twinform mcp` offers agents: its answers, that they are those of the commands, and what it refuses."""

import asyncio
import json
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from twinform.cli import main
from twinform.cli.model_tools import TOOLS, ModelTools, answer
from twinform.file_access import CEILING
from twinform.server.checking import LARGEST

pytest.importorskip("mcp", reason="mcp is not installed")

from testbed.agent import Agent, agent

_ARM = """\
<robot name="arm">
  <link name="base_link"/>
  <link name="tip">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <joint name="lift" type="prismatic">
    <parent link="base_lnk"/>
    <child link="tip"/>
    <axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="10" velocity="1"/>
  </joint>
</robot>
"""
_SECRET = '<sdf version="1.9"><model name="secret"><link name="hidden_link"/></model></sdf>'
_LEAK = """\
<sdf version="1.9"><world name="w"><include><uri>{}</uri></include></world></sdf>
"""


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the server, in a repository with what it must not read."""
    (tmp_path / ".git").mkdir()
    (tmp_path / "secret.sdf").write_text(_SECRET)
    folder = tmp_path / "models"
    folder.mkdir()
    (folder / "arm.urdf").write_text(_ARM)
    (folder / ".hidden.urdf").write_text(_ARM)
    (folder / "out.urdf").symlink_to(tmp_path / "secret.sdf")
    (folder / "up").symlink_to(tmp_path)
    monkeypatch.chdir(folder)
    monkeypatch.setenv(CEILING, str(folder))
    return folder


def _ask(tool: str, **given: object) -> dict[str, Any]:
    found = answer(ModelTools(Path.cwd()), tool, given)
    assert not isinstance(found, str), found
    return found


def _refusal(tool: str, **given: object) -> str:
    found = answer(ModelTools(Path.cwd()), tool, given)
    assert isinstance(found, str), found
    return found


@pytest.mark.usefixtures("root")
@pytest.mark.parametrize(
    ("tool", "given", "command"),
    [
        ("check", {"path": "arm.urdf"}, "check arm.urdf --format json"),
        ("check", {"path": "gone.urdf"}, "check gone.urdf --format json"),
        ("stats", {"path": "fixed.urdf"}, "stats fixed.urdf --format json"),
        ("diff", {"a": "fixed.urdf", "b": "fixed.urdf"}, "diff fixed.urdf fixed.urdf --format json"),
    ],
)
def test_an_answer_is_what_the_command_prints_as_json(tool: str, given: dict[str, object], command: str) -> None:
    Path("fixed.urdf").write_text(_ARM.replace("base_lnk", "base_link"))
    done = CliRunner().invoke(main, command.split())
    assert _ask(tool, **given) == json.loads(done.stdout)


def test_fix_shows_what_it_would_change_and_writes_only_when_asked(root: Path) -> None:
    shown = _ask("fix", path="arm.urdf", unsafe=True)
    assert '+    <parent link="base_link"/>' in shown["difference"]
    assert shown["written"] == shown["files"][0]["diagnostics"] == []
    assert (root / "arm.urdf").read_text() == _ARM
    done = _ask("fix", path="arm.urdf", unsafe=True, write=True)
    assert done["written"] == ["arm.urdf"]
    assert (root / "arm.urdf").read_text() == _ARM.replace("base_lnk", "base_link")


def test_fix_without_unsafe_makes_no_guess(root: Path) -> None:
    done = _ask("fix", path="arm.urdf", write=True)
    assert done["written"] == []
    assert done["files"][0]["diagnostics"][0]["rule"] == "dangling-link"
    assert (root / "arm.urdf").read_text() == _ARM


def test_convert_answers_with_the_text_or_writes_it(root: Path) -> None:
    (root / "fixed.urdf").write_text(_ARM.replace("base_lnk", "base_link"))
    text = _ask("convert", path="fixed.urdf", to="sdf", sdf_version="1.9")["text"]
    assert 'version="1.9">' in text
    done = _ask("convert", path="fixed.urdf", to="sdf", sdf_version="1.9", output="made/arm.sdf")
    assert done["written"] == ["made/arm.sdf"]
    assert (root / "made/arm.sdf").read_text() == text
    assert done["ledger"]["expressed"] > 0


def test_a_mesh_that_stands_for_a_shape_is_written_with_the_result(root: Path) -> None:
    egg = "<collision name='c'><geometry><ellipsoid/></geometry></collision>"
    (root / "egg.sdf").write_text(f"<sdf version='1.11'><model name='m'><link name='a'>{egg}</link></model></sdf>")
    assert "<mesh" not in _ask("convert", path="egg.sdf", to="urdf")["text"]
    robot, mesh = _ask("convert", path="egg.sdf", to="urdf", output="made/egg.urdf")["written"]
    assert mesh.removeprefix("made/") in (root / robot).read_text()
    assert (root / mesh).is_file()


@pytest.mark.usefixtures("root")
def test_a_model_with_errors_is_answered_with_its_findings() -> None:
    for tool, given in (("convert", {"path": "arm.urdf", "to": "sdf"}), ("stats", {"path": "arm.urdf"})):
        found = _ask(tool, **given)
        assert [each["rule"] for each in found["files"][0]["diagnostics"]] == ["dangling-link"]
        assert "text" not in found


def test_a_slice_of_the_schema_has_types_parents_and_children() -> None:
    (axis,) = _ask("schema", format="urdf", element="joint/axis")["places"]
    assert axis["parents"] == ["joint"]
    assert [each["name"] for each in axis["attributes"]] == ["xyz"]
    limits = _ask("schema", format="sdf", element="limit", version="1.9")["places"]
    assert {"joint/axis/limit", "joint/axis2/limit"} <= {each["path"] for each in limits}
    lower = next(each for each in limits[0]["children"] if each["name"] == "lower")
    assert lower["type"] == "double"
    assert lower["default"] == "-1e16"
    assert "expressed_in" not in str(_ask("schema", format="sdf", element="axis/xyz", version="1.6"))


@pytest.mark.usefixtures("root")
@pytest.mark.parametrize(
    "path", ["../secret.sdf", "/etc/hostname", "out.urdf", "up/secret.sdf", ".hidden.urdf", "x/../../secret.sdf"]
)
@pytest.mark.parametrize("tool", ["check", "fix", "stats"])
def test_no_tool_takes_what_is_hidden_or_not_below_the_root(tool: str, path: str) -> None:
    assert "is hidden or not below the root" in _refusal(tool, path=path)


@pytest.mark.parametrize("uri", ["../secret.sdf", "file://{outside}", "up/secret.sdf", "out.urdf"])
def test_nothing_above_the_root_is_read_because_of_a_model(uri: str, root: Path) -> None:
    secret = root.parent / "secret.sdf"
    (root / "world.sdf").write_text(_LEAK.format(uri.format(outside=secret)))
    for tool, given in (("check", {}), ("convert", {"to": "urdf"}), ("stats", {})):
        assert "hidden_link" not in json.dumps(_ask(tool, path="world.sdf", **given))


def test_what_lies_anywhere_below_the_root_is_read_because_of_a_model(root: Path) -> None:
    (root / "worlds").mkdir()
    (root / "parts").mkdir()
    (root / "parts/box.sdf").write_text(_SECRET)
    (root / "worlds/w.sdf").write_text(_LEAK.format("../parts/box.sdf"))
    assert _ask("check", path="worlds/w.sdf")["files"][0]["diagnostics"] == []


@pytest.mark.parametrize(
    ("output", "why"),
    [
        ("../made.sdf", "not below the root"),
        (".git/hooks.sdf", "hidden"),
        ("up/made.sdf", "not below the root"),
        ("setup.py", "has to end in .sdf"),
        ("fixed.sdf", "which is read"),
    ],
)
def test_convert_writes_no_other_file(output: str, why: str, root: Path) -> None:
    (root / "fixed.sdf").write_text(_SECRET)
    assert why in _refusal("convert", path="fixed.sdf", to="sdf", output=output)
    assert (root / "fixed.sdf").read_text() == _SECRET


@pytest.mark.usefixtures("root")
@pytest.mark.parametrize(
    ("tool", "given", "why"),
    [
        ("explain", {"rule": "dangling-lnk"}, "did you mean 'dangling-link'"),
        ("schema", {"format": "urdf", "element": "jiont"}, "did you mean 'joint'"),
        ("schema", {"format": "sdf", "element": "joint", "version": "1.99"}, "it has 1.2"),
        ("convert", {"path": "arm.urdf", "to": "sdf", "sdf_version": "9"}, "SDF has no version"),
        ("convert", {"path": "arm.urdf", "to": "sdf", "passes": "fill-limts"}, "fill-limits"),
        (
            "convert",
            {"path": "arm.urdf", "to": "sdf", "passes": "bridge-config{file=b.yaml}"},
            "run `twinform",
        ),
        ("check", {"path": "\0"}, "null"),
    ],
)
def test_what_a_tool_cannot_do_is_said(tool: str, given: dict[str, object], why: str) -> None:
    assert why in _refusal(tool, **given)


def test_files_have_the_limits_of_the_editor(root: Path) -> None:
    (root / "large.urdf").write_text(f"{_ARM}<!--{'x' * LARGEST}-->")
    for tool, given in (("check", {}), ("convert", {"to": "sdf"}), ("stats", {}), ("fix", {})):
        (found,) = _ask(tool, path="large.urdf", **given)["files"][0]["diagnostics"]
        assert found["rule"] in {"oversized-file", "unreadable-file"}
        assert "text" not in found


def test_settings_that_are_wrong_are_named(root: Path) -> None:
    (root / "twinform.toml").write_text("allow = 3\n")
    assert "allow" in _ask("check", path="arm.urdf")["ignored_settings"]


def test_an_agent_is_told_what_there_is_and_gets_structured_answers(root: Path) -> None:
    async def session(client: Agent) -> None:
        tools = {each.name: each for each in (await client.session.list_tools()).tools}
        assert set(tools) == set(TOOLS)
        for each in tools.values():
            assert each.description
            properties: dict[str, dict[str, str]] = each.input_schema["properties"]
            assert all(one["description"] for one in properties.values())
        hints = {name: each.annotations for name, each in tools.items()}
        assert {name for name, each in hints.items() if each and not each.read_only_hint} == {"fix", "convert"}
        found = await client.ask("check", path="arm.urdf")
        assert found["files"][0]["diagnostics"][0]["rule"] == "dangling-link"
        with pytest.raises(ValueError, match="not below the root"):
            await client.ask("check", path="../secret.sdf")
        with pytest.raises(ValueError, match="format"):
            await client.ask("schema", format="usd", element="joint")

    asyncio.run(agent(root, session))


def test_without_the_sdk_the_command_says_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "mcp.server", None)
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(main, ["mcp"])
    assert done.exit_code == 2
    assert "pip install" in done.stderr


def test_a_root_that_is_not_there_is_refused() -> None:
    assert CliRunner().invoke(main, ["mcp", "nowhere"]).exit_code == 2
