"""What only MJCF says stays where a file follows a URDF, also where it is written anew."""

from pathlib import Path

import pytest
from lxml import etree

from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.in_place import Updated
from twinform.compiler.into import Follower
from twinform.compiler.syncing import SyncedFile, SyncOptions, sync_file

_CASE = Path(__file__).parents[2] / "cases/sync/outdated_mjcf_keeps_its_own_parts"


def _synced(folder: Path, *, text: str | None = None) -> SyncedFile:
    target = folder / "file.xml"
    target.write_text(text or (_CASE / "file.xml").read_text())
    request = ConversionRequest(to="mjcf")
    return sync_file(request, _CASE / "source.urdf", target, LoadOptions(), SyncOptions())


def _no_change(follower: Follower) -> Updated:
    content = follower.into.content or b""
    return Updated(follower.conversion, content, (), content)


def test_a_file_that_is_written_anew_keeps_its_own_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Follower, "updated", _no_change)
    made = _synced(tmp_path)
    assert made.anew
    root = etree.fromstring(made.data or b"")
    joints = [(each.get("range"), each.get("armature")) for each in root.iterfind(".//body/joint")]
    assert joints == [("-1 1.5", "0.01")]
    assert [(each.get("joint"), each.get("kp")) for each in root.iterfind("actuator/position")] == [("turn", "20")]
    sites = [(each.get("name"), each.get("pos"), each.get("size")) for each in root.iter("site")]
    assert sites == [("tool", "0 0 0.1", "0.01")]
    assert root.find(".//light") is not None
    assert root.find(".//freejoint") is None  # as in the URDF, the base stands on the world


def test_a_part_that_is_gone_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Follower, "updated", _no_change)
    text = (_CASE / "file.xml").read_text().replace('<body name="tip"', '<body name="nose"')
    made = _synced(tmp_path, text=text)
    root = etree.fromstring(made.data or b"")
    assert [each.get("name") for each in root.iter("body")] == ["base", "tip"]
    assert root.find(".//site") is None


def test_what_travels_in_the_source_is_older_than_what_the_file_says(tmp_path: Path) -> None:
    """The URDF was made of an MJCF whose servo has other gains now."""
    target, source = tmp_path / "file.xml", tmp_path / "source.urdf"
    target.write_text((_CASE / "file.xml").read_text())
    made = sync_file(ConversionRequest(to="urdf"), target, source, LoadOptions(), SyncOptions())
    assert b"tf:mjcf" in (made.data or b"")
    source.write_bytes((made.data or b"").replace(b'mass value="2"', b'mass value="4"'))
    target.write_text(target.read_text().replace('kp="20"', 'kp="30"'))
    made = sync_file(ConversionRequest(to="mjcf"), source, target, LoadOptions(), SyncOptions())
    assert [change.new for change in made.changes] == ["4"]
