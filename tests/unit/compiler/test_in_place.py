"""Conversions in place: what a pass changes is changed, and every other byte stays."""

import difflib
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler import CompileError, ConversionRequest, LoadOptions
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input import parsing
from twinform.passes import parse_pipeline
from twinform.schemas import XmlElement

ROBOT = """<?xml version='1.0'  encoding="utf-8"?>
<!-- by hand -->
<robot   name="r"  >
\t<link name='base'/>  <!-- where it stands -->

\t<link name='arm'><inertial><mass value = '1.50'/>
\t\t<inertia ixx="1e-2" ixy="0" ixz="0" iyy="0.010" iyz="0" izz="0.01"/></inertial></link>
\t<joint type="prismatic" name="j">
\t\t<!-- the parent -->
\t\t<parent link="base"/><child link="arm"/>
\t\t<limit lower="0.0" upper="+1.0" effort="10.0" velocity='2'/>
\t</joint>
</robot>
"""


def _after(folder: Path, text: str | bytes, passes: str) -> bytes:
    path = folder / "r.urdf"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    request = ConversionRequest(to="urdf", passes=parse_pipeline(passes))
    return convert_in_place(request, path, LoadOptions()).data


def test_the_file_is_parsed_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parsed: list[bytes] = []

    def counting(text: bytes, *given: Any, **options: Any) -> XmlElement:
        parsed.append(text)
        return parsing.parse(text, *given, **options)

    monkeypatch.setattr("twinform.compiler.input.loading.parse", counting)
    assert _after(tmp_path, ROBOT, "rename{names=[base:foot]}") != ROBOT.encode()
    assert parsed == [ROBOT.encode()]


def _lines(text: str, made: bytes) -> list[str]:
    found = difflib.unified_diff(text.splitlines(), made.decode().splitlines(), n=0, lineterm="")
    return [line for line in found if line[:1] in "+-" and line[:3] not in {"+++", "---"}]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_a_pass_that_changes_nothing_touches_nothing(tmp_path: Path, encoding: str) -> None:
    data = ROBOT.replace("\n", "\r\n").encode(encoding)
    assert _after(tmp_path, data, "check-inertia") == data


def test_only_what_a_pass_changes_differs(tmp_path: Path) -> None:
    made = _after(tmp_path, ROBOT.replace(" velocity='2'", ""), "fill-limits{velocity=3.0}")
    assert _lines(ROBOT, made) == [
        """-\t\t<limit lower="0.0" upper="+1.0" effort="10.0" velocity='2'/>""",
        """+\t\t<limit lower="0.0" upper="+1.0" effort="10.0" velocity="3"/>""",
    ]


def test_a_new_name_is_followed_where_it_stands(tmp_path: Path) -> None:
    made = _after(tmp_path, ROBOT, "rename{names=[base:foot]}")
    assert _lines(ROBOT, made) == [
        "-\t<link name='base'/>  <!-- where it stands -->",
        "+\t<link name='foot'/>  <!-- where it stands -->",
        '-\t\t<parent link="base"/><child link="arm"/>',
        '+\t\t<parent link="foot"/><child link="arm"/>',
    ]


def test_what_has_no_places_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CompileError, match=r"cannot be changed in place: .*line 2") as caught:
        _after(tmp_path, ROBOT.replace("by hand", "by -- hand"), "prefix-names{prefix=x_}")
    assert caught.value.diagnostics[-1].rule.name == "edit-conflict"
