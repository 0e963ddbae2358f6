"""Mimics of what has no axis: SDF does not have them, and they come back unless an edit would make them act."""

import twinform
from tests.snippets import INERTIAL

_LINKS = "".join(f'<link name="{name}">{INERTIAL}</link>' for name in ("base", "a", "b"))
_ENDS = '<parent link="base"/><child link="{}"/><axis xyz="0 0 1"/>'
_ROBOT = (
    f'<robot name="r">{_LINKS}<joint name="left" type="continuous">{_ENDS.format("a")}</joint>'
    f'<joint name="right" type="continuous">{_ENDS.format("b")}<mimic joint="lost"/></joint></robot>'
)


def _back(sdf: str) -> twinform.Conversion:
    return twinform.convert(sdf.encode(), to="urdf")


def test_it_comes_back_as_it_was() -> None:
    sdf = twinform.convert(_ROBOT.encode(), to="sdf").text
    assert "unknown-leader" not in {each.rule.name for each in twinform.check(sdf.encode()).diagnostics}
    assert '<mimic joint="lost"/>' in _back(sdf).text


def test_it_does_not_come_back_where_a_joint_has_the_name_by_now() -> None:
    sdf = twinform.convert(_ROBOT.encode(), to="sdf").text.replace('"left"', '"lost"')
    made = _back(sdf)
    assert "<mimic" not in made.text
    assert "stale-carrier" in {each.rule.name for each in made.diagnostics}


def test_it_does_not_overrule_a_mimic_of_the_file() -> None:
    sdf = twinform.convert(_ROBOT.encode(), to="sdf").text
    before, axis, after = sdf.rpartition("</axis>")
    made = _back(f'{before}<mimic joint="left"/>{axis}{after}')
    assert made.text.count("<mimic") == 1
    assert '<mimic joint="left"/>' in made.text
