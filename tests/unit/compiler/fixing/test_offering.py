"""Which findings get a fix, and where its edits lead."""

from pathlib import Path

import pytest

from twinform.compiler import LoadOptions, expand, inspect, read
from twinform.compiler.fixing import with_fixes
from twinform.diagnostics import Diagnostic
from twinform.text import ElementSpan, SourceText, apply, spans


def _offered(source: Path | bytes) -> dict[str, Diagnostic]:
    loaded = inspect(read(source, LoadOptions()), LoadOptions())
    return {each.rule.name: each for each in with_fixes(loaded)}


ROBOT = (
    "<robot name='r'><link name='base'/><link name='tip'/>"
    "<joint name='j' type='revolute'><parent link='base'/>{}</joint></robot>"
)


def _box(size: str) -> str:
    shape = f"<visual><geometry><box size='{size}'/></geometry></visual>"
    return f"<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><link name='a'>{shape}</link></robot>"


def test_offsets_are_those_of_the_text() -> None:
    data = "\ufeff<!-- \u2603 -->\r\n" + _box("1,1,1")
    found = _offered(data.encode())["invalid-value"]
    assert found.fix
    assert "<box size='1 1 1'/>" in apply(SourceText.of(data.encode()).text, found.fix.edits)


def test_a_fix_for_display_says_what_to_fill_in() -> None:
    found = _offered(ROBOT.format("<child link='tip'/><limit lower='0' upper='1' velocity='1'/>").encode())
    fix = found["missing-attribute"].fix
    assert fix
    assert (fix.safety, fix.edits[0].new) == ("display", " effort=''")


@pytest.mark.parametrize("value", ["${width} ,1", "$(arg x),1,1"])
def test_expressions_are_left_alone(value: str) -> None:
    assert all(each.fix is None for each in _offered(_box(value).encode()).values())


def test_what_xacro_makes_is_fixed_where_it_is_written(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    path.write_text(_box("1,1,1"))
    fix = _offered(path)["invalid-value"].fix
    assert fix
    assert apply(path.read_text(), fix.edits) == _box("1 1 1")


def test_json_has_none() -> None:
    data = b'{"format": "urdf", "models": [{"name": "r", "links": [{"name": "a", "lenght": 1}]}]}'
    assert all(each.fix is None for each in _offered(data).values())


def test_a_finding_in_an_included_file_has_none(tmp_path: Path) -> None:
    folder = tmp_path / "inner"
    folder.mkdir()
    link = "<link name='a'><gravity>1</gravity><gravity>1</gravity></link>"
    inner = f"<sdf version='1.9'><model name='m'>{link}</model></sdf>"
    (folder / "model.sdf").write_text(inner)
    (folder / "model.config").write_text("<model><name>m</name><sdf version='1.9'>model.sdf</sdf></model>")
    path = tmp_path / "w.sdf"
    path.write_text("<sdf version='1.9'><world name='w'><include><uri>inner</uri></include></world></sdf>")
    loaded = expand(read(path, LoadOptions()), LoadOptions())
    found = [each for each in with_fixes(loaded) if each.rule.name == "repeated-element"]
    assert found
    assert all(each.fix is None for each in found)
    assert _offered(folder / "model.sdf")["repeated-element"].fix


def test_places_are_found_where_something_is_edited(monkeypatch: pytest.MonkeyPatch) -> None:
    """To find them takes as long as to check the file, and most fixers have nothing to edit."""
    asked = list[str]()

    def find(text: str) -> ElementSpan:
        asked.append(text)
        return spans(text)

    monkeypatch.setattr("twinform.compiler.fixing.site.spans", find)
    twice = "<sdf version='1.11'><model name='m'><link name='a'/></model><model name='m'><link name='a'/></model></sdf>"
    assert _offered(twice.encode())["repeated-element"].fix is None
    assert not asked
    assert _offered(_box("1,1,1").encode())["invalid-value"].fix
    assert len(asked) == 1
