"""What `check` says of the files of meshes: those that are none, and large ones that are touched."""

import struct
from pathlib import Path

import pytest

import twinform

_ROBOT = (
    '<robot name="r"><link name="a"><visual><geometry><mesh filename="{0}"/></geometry></visual>'
    '<collision><geometry><mesh filename="{0}"{1}/></geometry></collision></link></robot>'
)


def _stl(count: int, size: float = 0.1) -> bytes:
    triangle = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, size, 0, 0, 0, size, 0, 0)
    return b"\0" * 80 + struct.pack("<I", count) + triangle * count


def _rules(folder: Path, name: str, content: bytes, scale: str = "") -> list[str]:
    (folder / name).write_bytes(content)
    robot = folder / "robot.urdf"
    robot.write_text(_ROBOT.format(name, scale), "utf-8")
    return [each.rule.name for each in twinform.check(robot).diagnostics]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.stl", _stl(2)),
        ("a.STL", b"solid named\0" + _stl(2)[12:]),  # a binary file may begin with the word
        ("a.stl", b"solid a\nfacet normal 0 0 1\nendsolid\n"),
        ("a.obj", b"# by hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("a.dae", b'<?xml version="1.0"?><COLLADA version="1.4.1"/>'),
        ("a.ply", b"ply\nformat ascii 1.0\n"),
        ("a.fbx", b"whatever this is"),
    ],
)
def test_a_mesh_is_one(tmp_path: Path, name: str, content: bytes) -> None:
    assert _rules(tmp_path, name, content) == []


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.stl", b""),
        ("a.stl", _stl(2)[:-20]),
        ("a.stl", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" * 9),
        ("a.stl", b"<!DOCTYPE html><html>Not Found</html>"),
        ("a.obj", b"not a mesh"),
        ("a.dae", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
        ("a.dae", b"<html/>"),
        ("a.glb", b"glTG"),
    ],
)
def test_a_mesh_is_none(tmp_path: Path, name: str, content: bytes) -> None:
    assert _rules(tmp_path, name, content) == ["broken-mesh"]


def test_a_mesh_of_two_scales_is_found(tmp_path: Path) -> None:
    assert _rules(tmp_path, "a.stl", _stl(2, 90.0), ' scale="0.001 0.001 0.001"') == ["implausible-size"]
    assert _rules(tmp_path, "a.stl", _stl(2, 0.09), ' scale="0.001 0.001 0.001"') == ["implausible-size"]
    assert _rules(tmp_path, "a.stl", _stl(2, 0.09), ' scale="0.9 0.9 0.9"') == []


def test_a_large_mesh_to_touch_is_a_note(tmp_path: Path) -> None:
    assert _rules(tmp_path, "a.stl", _stl(30000)) == ["detailed-collision"]
