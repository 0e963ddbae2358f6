from pathlib import Path

import pytest

import twinform
from twinform.cli.files.model_files import is_model

_XACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"{}>{}</robot>'
_MACRO = '<xacro:macro name="m" params="x"><link name="${x}"/></xacro:macro>'


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.urdf", "", True),
        ("A.URDF", "", True),
        ("a.sdf", "", True),
        ("model.sdf", "", True),
        ("a.world", "", True),
        ("a.xml", "", False),
        ("a.urdf.bak", "", False),
        ("a.xacro", _XACRO.format(' name="r"', "<link name='a'/>"), True),
        ("a.xacro", _XACRO.format(' name="r"', _MACRO + "<xacro:m x='1'/>"), True),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:include filename='b.xacro'/>"), True),
        ("a.urdf.xacro", _XACRO.format(' name="r"', _MACRO), False),
        ("a.urdf.xacro", _XACRO.format("", "<link name='a'/>"), False),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:include filename='b.xacro'/>" + _MACRO), False),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:property name='p' value='1'/><material name='red'/>"), False),
        ("a.xacro", "<sdf version='1.9'/>", True),
        ("a.xacro", "<launch/>", False),
        ("a.xacro", "", False),
        ("a.xacro", "<robot name='r'><link", True),
        ("a.json", "{}", False),
        ("a.json", '{"robot": 1}', False),
    ],
)
def test_which_files_are_models(tmp_path: Path, name: str, text: str, expected: bool) -> None:
    path = tmp_path / name
    path.write_text(text)
    assert is_model(path) is expected


def test_our_json_is_one(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text(twinform.dumps(twinform.loads('<robot name="r"><link name="a"/></robot>'), to="json"))
    assert is_model(path)


def test_a_pattern_may_name_other_endings(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text("<robot/>")
    (tmp_path / "m.xacro").write_text(_XACRO.format("", _MACRO))
    assert is_model(tmp_path / "a.xml", named=True)
    assert not is_model(tmp_path / "m.xacro", named=True)
