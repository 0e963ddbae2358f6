"""A single hostile file ends with one clear error, within 2 s and 512 MB, and nothing else is read or written."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform
from tests.hostile.documents import DOCUMENTS


@pytest.mark.parametrize("name", DOCUMENTS)
def test_a_hostile_file_ends_with_one_error(name: str, tmp_path: Path) -> None:
    hostile = DOCUMENTS[name]
    (tmp_path / "hostile.urdf").write_bytes(hostile.make())
    outcome = twinform("check", "hostile.urdf", folder=tmp_path)
    assert outcome.code in {1, 2}, outcome.output
    assert rules(outcome.output) == [hostile.rule], outcome.output[:2000]
    place = rf":{hostile.line}(:\d+)?" if hostile.line else ""
    assert re.match(rf"hostile\.urdf{place}: error: ", outcome.output)
    assert len(outcome.output) < 5000
    assert outcome.opened == {str(tmp_path / "hostile.urdf")}
    assert [each.name for each in tmp_path.iterdir()] == ["hostile.urdf"]


def test_a_device_without_an_end_is_cut_off(tmp_path: Path) -> None:
    outcome = twinform("check", "/dev/zero", folder=tmp_path)
    assert (outcome.code, rules(outcome.output)) == (1, ["oversized-file"])


NAMES = {
    "a line break": "b&#10;evil.urdf:1: error: forged [not-well-formed]",
    "a command of a terminal": "\x9b31mred",
    "a command of GitHub": "b&#10;::error file=a.urdf::forged",
    "a command of a shell": "$(touch pwned); `touch pwned` | touch pwned",
}


@pytest.mark.parametrize(
    "style", ["text", "github", *(pytest.param(each, marks=pytest.mark.deep) for each in ("json", "sarif"))]
)
@pytest.mark.parametrize("name", NAMES)
def test_a_name_forges_no_finding_and_runs_nothing(name: str, style: str, tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="a"/><link name="{NAMES[name]}"/></robot>')
    outcome = twinform("check", "--format", style, "r.urdf", folder=tmp_path)
    assert outcome.code == 1
    if style == "text":  # SARIF has a list of all rules
        assert ("unprintable-name" in outcome.output) is not NAMES[name].startswith("$")
    assert not [line for line in outcome.output.splitlines() if line.startswith(("evil.urdf", "::error file=a.urdf"))]
    assert "\x9b" not in outcome.output or style == "github"
    assert [each.name for each in tmp_path.iterdir()] == ["r.urdf"]


_LONG_TO_FIND = {
    "digits.urdf": f'<robot name="r"><link name="a"><x y="{"1" * 300_000}\tx"/></link></robot>',
    "tabs.urdf": '<robot name="r"><link name="a">' + '<x y="1\t2"/>\n' * 10_000 + "</link></robot>",
    "comments.sdf": '<sdf version="1.9"><model name="m">' + "<x>1<!-- -->2</x>" * 10_000 + "</model></sdf>",
}
"""What searches of the text itself once needed the square of its length for."""


@pytest.mark.parametrize("name", _LONG_TO_FIND)
def test_what_is_found_in_the_text_is_found_in_linear_time(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(_LONG_TO_FIND[name])
    assert twinform("check", name, folder=tmp_path).code in {0, 1}


def test_what_takes_long_to_describe_is_described_in_linear_time(tmp_path: Path) -> None:
    """Paths count siblings, and 10,000 unknown elements once took eight seconds."""
    unknown = "<x/>" * 10_000
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="a"/>{unknown}<gazebo>{unknown}</gazebo></robot>')
    assert twinform("check", "r.urdf", folder=tmp_path).code == 0


def _declared(count: int) -> str:
    return " ".join(f'xmlns:p{n}="urn:{n}"' for n in range(count))


def _used(count: int, each: str) -> str:
    return "".join(each.replace("%", str(n)) for n in range(count))


_JOINT = '<link name="l%"/><joint name="j%" type="fixed"><parent link="a"/><child link="l%"/></joint>'
_MANY: dict[str, tuple[str, int]] = {
    "unknown attributes": (_JOINT.replace("/>", ' foo="1"/>'), 0),
    "wrong values": ('<joint name="j%" type="bad"><parent link="a"/><child link="a"/></joint>', 1),
    "settings of joints": (_JOINT + '<gazebo reference="j%"><mu1>1</mu1></gazebo>', 0),
}


@pytest.mark.parametrize("name", _MANY)
def test_what_the_schema_refuses_often_is_refused_in_linear_time(name: str, tmp_path: Path) -> None:
    """Each error of an element once counted all of its siblings."""
    each, code = _MANY[name]
    (tmp_path / "many.urdf").write_text(f'<robot name="r"><link name="a"/>{_used(6_000, each)}</robot>')
    assert twinform("check", "many.urdf", folder=tmp_path, seconds=8).code == code


_NAMESPACES: dict[str, Callable[[int], tuple[str, str]]] = {
    "at the root": lambda count: ("", _declared(count)),
    "at the root, and used": lambda count: (_used(count, '<p%:x p%:y="1"/>'), _declared(count)),
    "inside": lambda count: (_used(count, '<p%:x xmlns:p%="urn:%"/>'), ""),
    "inside, of one prefix": lambda count: (_used(count, '<p:x xmlns:p="urn:%"/>'), ""),
    "undeclared": lambda count: (_used(count, '<p%:x/><q p%:y=""/>'), ""),
}


def _model(language: str, inside: str, root: str) -> str:
    if language == "urdf":
        return f'<robot name="r" {root}><link name="a"/><gazebo>{inside}</gazebo></robot>'
    return f'<sdf version="1.11" {root}><model name="m"><link name="a">{inside}</link></model></sdf>'


@pytest.mark.parametrize("language", ["urdf", "sdf"])
@pytest.mark.parametrize("where", _NAMESPACES)
def test_8000_namespaces_are_read_in_linear_time(where: str, language: str, tmp_path: Path) -> None:
    """It once took 88 seconds."""
    name = f"many.{language}"
    (tmp_path / name).write_text(_model(language, *_NAMESPACES[where](8000)))
    outcome = twinform("check", name, folder=tmp_path)
    assert outcome.code == 0, outcome.output[-2000:]


@pytest.mark.parametrize("where", _NAMESPACES)
def test_many_namespaces_are_written_too(where: str, tmp_path: Path) -> None:
    (tmp_path / "many.urdf").write_text(_model("urdf", *_NAMESPACES[where](1500)))
    outcome = twinform("convert", "many.urdf", "--to", "urdf", folder=tmp_path)
    assert outcome.code == 0, outcome.output[-2000:]
