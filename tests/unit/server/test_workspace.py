"""Findings of files that are not open."""

import asyncio
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types

from testbed.editor.client import Editor, editor

pytestmark = pytest.mark.slow

GOOD = '<robot name="r"><link name="a"/></robot>'
BAD = '<robot name="r"><link name="a"/><link name="a"/></robot>'
TOP = '<robot name="t" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="part.xacro"/></robot>'


@pytest.fixture(name="folder")
def workspace(tmp_path: Path) -> Path:
    texts = {"good.urdf": GOOD, "bad.urdf": BAD, "top.urdf.xacro": TOP, "part.xacro": "<robot><link nam='a'/></robot>"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def codes(found: list[types.Diagnostic]) -> set[str]:
    return {str(each.code) for each in found}


def test_files_that_are_not_open_have_findings_and_follow_what_happens_to_them(folder: Path) -> None:
    bad, part = (folder / "bad.urdf"), (folder / "part.xacro").as_uri()

    async def steps(one: Editor) -> None:
        assert "duplicate-name" in codes(await one.diagnostics(bad.as_uri(), until=bool))
        # a part of another file is checked where it is included, and not as a robot
        assert codes(await one.diagnostics(part, until=bool)) == {"unknown-attribute"}
        assert (folder / "good.urdf").as_uri() not in {uri for uri, told in one.told.items() if told.diagnostics}

        one.open(bad, GOOD)
        assert await one.diagnostics(bad.as_uri(), until=lambda found: not found) == []
        one.told.clear()
        one.close(bad.as_uri())  # nothing was saved
        assert "duplicate-name" in codes(await one.diagnostics(bad.as_uri(), until=bool))

        bad.write_text(GOOD, encoding="utf-8")
        _tell(one, bad, types.FileChangeType.Changed)
        await one.diagnostics(bad.as_uri(), until=lambda found: not found)
        one.open(folder / "part.xacro", "<robot><link name='a'/></robot>")
        await one.diagnostics(part, until=lambda found: not found)

    asyncio.run(_session(folder, steps, {"checkWorkspace": True}))


def test_a_file_that_is_deleted_has_no_findings(folder: Path) -> None:
    bad = folder / "bad.urdf"

    async def steps(one: Editor) -> None:
        await one.diagnostics(bad.as_uri(), until=bool)
        bad.unlink()
        _tell(one, bad, types.FileChangeType.Deleted)
        await one.diagnostics(bad.as_uri(), until=lambda found: not found)

    asyncio.run(_session(folder, steps, {"checkWorkspace": True}))


def test_nothing_is_checked_that_nobody_asked_for(folder: Path) -> None:
    async def steps(one: Editor) -> None:
        good = one.open(folder / "good.urdf")
        await one.diagnostics(good)
        assert set(one.told) == {good}

    asyncio.run(_session(folder, steps, None))


def _tell(one: Editor, path: Path, change: types.FileChangeType) -> None:
    event = types.FileEvent(path.as_uri(), change)
    one.client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams([event]))


async def _session(folder: Path, steps: Callable[[Editor], Coroutine[Any, Any, None]], options: object) -> None:
    async with editor(folder, options=options) as one:
        await steps(one)
