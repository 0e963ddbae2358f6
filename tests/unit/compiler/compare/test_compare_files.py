"""Robots of which both files say the same are read once."""

from pathlib import Path
from unittest.mock import patch

import twinform
from twinform.compiler.compare import read_robots

_MODEL = '<model name="{0}"><link name="base"><inertial><mass>{1}</mass></inertial></link></model>'


def _world(*models: tuple[str, int]) -> bytes:
    texts = (f'<world name="w{number}">\n{_MODEL.format(*each)}\n</world>' for number, each in enumerate(models))
    return f'<sdf version="1.11">\n{"".join(texts)}\n</sdf>'.encode()


def test_one_robot_is_built_for_both_files() -> None:
    a, b = _world(("arm", 1), ("leg", 1)), _world(("arm", 1), ("leg", 2))
    with patch.object(read_robots, "build_robot", wraps=read_robots.build_robot) as build:
        found = twinform.diff(a, b)
    assert [call.args[0].name for call in build.mock_calls] == ["arm", "leg", "leg"]
    assert {each.model for each in found.differences} == {"leg"}


def test_a_robot_that_both_files_have_has_its_place_in_each() -> None:
    # two of a name in the second file: there its own is called after the world
    found = twinform.diff(_world(("arm", 1), ("leg", 1)), b"<!-- a line -->\n" + _world(("arm", 1), ("arm", 1)))
    lines = {(each.a.location.line, each.b.location.line) for each in found.differences if each.aspect == ""}
    assert (3, 0) in lines
    assert (0, 4) in lines


def test_paths_from_two_folders_to_one_file_are_the_same(tmp_path: Path) -> None:
    mesh = "<geometry><mesh><uri>{}</uri></mesh></geometry>"
    model = f'<sdf version="1.11"><model name="m"><link name="l"><visual name="v">{mesh}</visual></link></model></sdf>'
    for name, uri in {"a/arm.sdf": "hand.stl", "b/arm.sdf": "../a/hand.stl", "c/arm.sdf": "../b/hand.stl"}.items():
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text(model.format(uri))
    for name in ("a/hand.stl", "b/hand.stl"):
        (tmp_path / name).write_text("solid hand\nendsolid hand\n")
    assert twinform.diff(tmp_path / "a/arm.sdf", tmp_path / "b/arm.sdf").same
    assert not twinform.diff(tmp_path / "a/arm.sdf", tmp_path / "c/arm.sdf").same
