"""Findings in an editor: through the installed command, over standard input and output."""

import asyncio
import os
import subprocess
import sys
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types

from testbed.editor.client import Editor, editor
from twinform.installation import install_command

pytestmark = pytest.mark.slow

ROBOT = """<robot name="r">
  <link name="base"/>
  <joint name="j" type="fixd">
    <parent link="base"/>
    <child link="arm"/>
  </joint>
</robot>
"""
LINKS = '<link name="base"/><link name="base2"/>'
Steps = Callable[[Editor], Coroutine[Any, Any, None]]


def run(folder: Path, steps: Steps, encodings: list[types.PositionEncodingKind] | None = None) -> None:
    async def session() -> None:
        async with editor(folder, encodings) as one:
            await steps(one)

    asyncio.run(session())


def codes(found: list[types.Diagnostic]) -> list[str]:
    return [str(each.code) for each in found]


def place(found: types.Diagnostic) -> tuple[int, int, int, int]:
    start, end = found.range.start, found.range.end
    return start.line, start.character, end.line, end.character


def test_findings_stand_at_the_piece_that_is_wrong_and_go_when_it_is_right(tmp_path: Path) -> None:
    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "robot.urdf", ROBOT)
        found, *others = await one.diagnostics(uri)
        assert (found.code, place(found), found.source) == ("invalid-value", (2, 24, 2, 28), "twinform")
        assert codes(others) == ["dangling-link"]
        version = one.change(uri, ((2, 27, 2, 28), "ed"), ((1, 2, 1, 2), '<link name="arm"/>'))
        assert codes(await one.diagnostics(uri, version)) == []
        one.close(uri)

    run(tmp_path, steps)


def test_a_finding_is_fixed_with_one_key(tmp_path: Path) -> None:
    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "robot.urdf", ROBOT.replace("arm", "base2").replace('<link name="base"/>', LINKS))
        (found,) = await one.diagnostics(uri)
        context = types.CodeActionContext([found], only=[types.CodeActionKind.QuickFix])
        params = types.CodeActionParams(types.TextDocumentIdentifier(uri), found.range, context)
        (action, *_) = await one.request(types.TEXT_DOCUMENT_CODE_ACTION, params)
        (edit,) = action.edit.changes[uri]
        assert (edit.new_text, edit.range) == ("fixed", found.range)
        start, end = edit.range.start, edit.range.end
        version = one.change(uri, ((start.line, start.character, end.line, end.character), edit.new_text))
        assert codes(await one.diagnostics(uri, version)) == []

    run(tmp_path, steps)


def test_a_text_that_is_not_well_formed_is_a_finding_like_others(tmp_path: Path) -> None:
    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "half.urdf", ROBOT[: ROBOT.index("</joint>")])
        (found,) = await one.diagnostics(uri)
        assert found.code == "not-well-formed"
        version = one.change(uri, "")
        (found,) = await one.diagnostics(uri, version)
        assert found.code == "unreadable-file"

    run(tmp_path, steps)


@pytest.mark.parametrize(
    ("encoding", "columns"),
    [
        (types.PositionEncodingKind.Utf16, (34, 39)),
        (types.PositionEncodingKind.Utf8, (37, 42)),
        (types.PositionEncodingKind.Utf32, (33, 38)),
    ],
)
def test_columns_are_counted_as_the_editor_counts(
    tmp_path: Path, encoding: types.PositionEncodingKind, columns: tuple[int, int]
) -> None:
    text = '<robot name="r">\r\n  <link name="é🤖"/><!-- --><link wrong="1" name="a"/>\r\n</robot>\r\n'

    async def steps(one: Editor) -> None:
        assert one.capabilities.position_encoding == encoding
        uri = one.open(tmp_path / "wide.urdf", text)
        found = next(each for each in await one.diagnostics(uri) if each.code == "unknown-attribute")
        assert place(found)[1::2] == columns

    run(tmp_path, steps, [encoding])


def test_only_the_line_ends_of_the_protocol_end_lines(tmp_path: Path) -> None:
    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "lines.urdf", "<!-- \u2028 \x85 \x0b -->\r" + ROBOT.replace("\n", "\r\n"))
        version = one.change(uri, ((3, 27, 3, 28), "ed"), ((2, 2, 2, 2), '<link name="arm"/>'))
        found = await one.diagnostics(uri, version)
        assert "invalid-value" not in codes(found)
        assert "not-well-formed" in codes(found)  # a vertical tab is none in XML
        version = one.change(uri, ((0, 9, 0, 10), " "))
        assert codes(await one.diagnostics(uri, version)) == []

    run(tmp_path, steps)


def test_files_that_are_open_are_read_from_the_editor(tmp_path: Path) -> None:
    space = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    top = tmp_path / "top.urdf.xacro"
    part = tmp_path / "part.xacro"
    top.write_text(f'<robot name="r" {space}>\n  <xacro:include filename="part.xacro"/>\n  <xacro:base/>\n</robot>\n')
    macro = (
        f'<robot {space}>\n  <xacro:macro name="base" params="">\n    <link name="base"/>\n  </xacro:macro>\n</robot>\n'
    )
    part.write_text(macro)

    async def steps(one: Editor) -> None:
        top_uri, part_uri = one.open(top), one.open(part)
        assert codes(await one.diagnostics(top_uri)) == []
        assert codes(await one.diagnostics(part_uri)) == []  # nothing is missing in a part
        one.change(part_uri, ((2, 10, 2, 21), 'nam="base"'))
        found = await one.diagnostics(part_uri, until=lambda found: len(found) > 0)
        assert {place(each)[0] for each in found} == {2}
        assert "unknown-attribute" in codes(found)
        assert part.read_text() == macro
        one.close(top_uri)
        assert codes(await one.diagnostics(part_uri, until=lambda found: not found)) == []

    run(tmp_path, steps)


HOSTILE = {
    "entities": '<!DOCTYPE robot [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><robot name="&b;"/>',
    "file": '<!DOCTYPE robot [<!ENTITY a SYSTEM "file:///etc/passwd">]><robot name="&a;"/>',
    "deep": "<robot>" + "<link>" * 20_000,
    "deep_whole": "<a>" * 5_000 + "</a>" * 5_000,
    "attributes": "<robot " + " ".join(f'a{n}="1"' for n in range(20_000)) + "/>",
    "quotes": "<robot " + 'x="' * 20_000,
    "comments": "<!--" * 20_000,
    "tags": "<link " * 20_000,
    "half a character": '<robot name="\ud800"/>',
    "another encoding": '<?xml version="1.0" encoding="utf-7"?><robot name="a"/>',
    "no encoding": '<?xml version="1.0" encoding="nonsense"?><robot name="a"/>',
    "zero": "\0<robot/>",
    "no XML": "\x7fELF",
}


def test_hostile_documents_are_findings_and_the_server_stays(tmp_path: Path) -> None:
    async def steps(one: Editor) -> None:
        for name, text in HOSTILE.items():
            uri = one.open(tmp_path / f"{name}.urdf", text)
            found = await one.diagnostics(uri)
            assert any(each.severity == types.DiagnosticSeverity.Error for each in found), name
            one.close(uri)
        uri = one.open(tmp_path / "robot.urdf", ROBOT)
        assert codes(await one.diagnostics(uri)) == ["invalid-value", "dangling-link"]

    run(tmp_path, steps)


def test_a_hostile_xacro_file_reads_nothing_and_ends(tmp_path: Path) -> None:
    text = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="a" value="${xacro.load_yaml('/etc/hostname')}"/>
  <link name="${a}"/>
</robot>"""
    forever = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="a" params=""><xacro:a/><xacro:a/></xacro:macro><xacro:a/>
</robot>"""

    async def steps(one: Editor) -> None:
        for number, each in enumerate((text, forever)):
            folder = tmp_path / "package"
            folder.mkdir(exist_ok=True)
            uri = one.open(folder / f"{number}.urdf.xacro", each)
            found = await one.diagnostics(uri)
            assert "xacro-error" in codes(found)

    run(tmp_path, steps)


def test_a_file_of_60_megabytes_is_a_message(tmp_path: Path) -> None:
    text = '<robot name="r">\n' + '  <link name="a"/>\n' * (60 * 2**20 // 19) + "</robot>\n"

    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "large.urdf", text)
        (found,) = await one.diagnostics(uri)
        assert found.message.startswith("the file has more than 4 MiB: it is not followed")
        version = one.change(uri, ((1, 0, 1, 0), " "))
        (found,) = await one.diagnostics(uri, version)
        assert found.message.startswith("the file has more than 4 MiB")
        small = one.open(tmp_path / "robot.urdf", ROBOT)
        assert codes(await one.diagnostics(small)) == ["invalid-value", "dangling-link"]
        version = one.change(uri, ROBOT)
        assert codes(await one.diagnostics(uri, version)) == ["invalid-value", "dangling-link"]

    run(tmp_path, steps)


def test_the_configuration_of_the_project_counts(tmp_path: Path) -> None:
    (tmp_path / "twinform.toml").write_text('allow = ["missing-inertial"]\ndeny = ["unknown-attribute"]\n')
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad" / "twinform.toml").write_text("alow = []\n")
    text = '<robot name="r"><link name="a" nam="b"/></robot>'

    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "robot.urdf", text)
        found = await one.diagnostics(uri)
        assert [(each.code, each.severity) for each in found] == [("unknown-attribute", types.DiagnosticSeverity.Error)]
        uri = one.open(tmp_path / "bad" / "robot.urdf", text)
        found = await one.diagnostics(uri)
        assert "the configuration cannot be used" in found[0].message
        assert "alow" in found[0].message

    run(tmp_path, steps)


def test_arguments_of_some_files_and_comments_that_allow_findings_count(tmp_path: Path) -> None:
    (tmp_path / "twinform.toml").write_text('[[files]]\nmatch = ["*.xacro"]\narguments = { size = 2 }\n')
    text = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="size" default=""/>
  <!-- twinform: allow unknown-attribute - on purpose -->
  <link name="a$(arg size)" nam="b"/>
  <link name="a2"/>
</robot>"""

    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "robot.urdf.xacro", text)
        found = await one.diagnostics(uri)
        assert "duplicate-name" in codes(found)
        assert "unknown-attribute" not in codes(found)

    run(tmp_path, steps)


def test_without_the_extra_the_command_says_what_to_install(tmp_path: Path) -> None:
    (tmp_path / "pygls.py").write_text("raise ModuleNotFoundError(\"No module named 'pygls'\", name='pygls')\n")
    done = subprocess.run(
        [sys.executable, "-m", "twinform", "lsp"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert f"run: {install_command('lsp')}" in done.stderr
