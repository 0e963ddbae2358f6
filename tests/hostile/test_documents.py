"""A single hostile file ends with one clear error, within 2 s and 512 MB, and nothing else is read or written."""

from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform
from tests.hostile.documents import DOCUMENTS


@pytest.mark.parametrize("name", DOCUMENTS)
def test_a_hostile_file_ends_with_one_error(name: str, tmp_path: Path) -> None:
    hostile = DOCUMENTS[name]
    (tmp_path / "hostile.urdf").write_bytes(hostile.make())
    outcome = twinform("check", "hostile.urdf", folder=tmp_path)
    assert outcome.code in {1, 2}, outcome.said
    assert rules(outcome.said) == [hostile.rule], outcome.said[:2000]
    assert outcome.said.startswith(f"hostile.urdf:{hostile.line}: " if hostile.line else "hostile.urdf: ")
    assert len(outcome.said) < 5000
    assert outcome.opened == {str(tmp_path / "hostile.urdf")}
    assert [each.name for each in tmp_path.iterdir()] == ["hostile.urdf"]


def test_a_device_without_an_end_is_cut_off(tmp_path: Path) -> None:
    outcome = twinform("check", "/dev/zero", folder=tmp_path)
    assert (outcome.code, rules(outcome.said)) == (2, ["oversized-file"])


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
        assert ("unprintable-name" in outcome.said) is not NAMES[name].startswith("$")
    assert not [line for line in outcome.said.splitlines() if line.startswith(("evil.urdf", "::error file=a.urdf"))]
    assert "\x9b" not in outcome.said or style == "github"
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
