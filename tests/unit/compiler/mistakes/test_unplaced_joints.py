"""Joints that lead nowhere, as while somebody types: what is placed in space is looked at, and nothing else."""

import pytest

import twinform

WHEEL = '<joint name="w" type="continuous">{}</joint>'
ENDS = {
    "no child": '<parent link="a"/>',
    "no parent": '<child link="b"/>',
    "an unknown child": '<parent link="a"/><child link="z"/>',
    "itself": '<parent link="b"/><child link="b"/>',
}


@pytest.mark.parametrize("name", ENDS)
def test_a_wheel_that_hangs_from_nothing_is_an_error_and_no_failure(name: str) -> None:
    text = f'<robot name="r"><link name="a"/><link name="b"/>{WHEEL.format(ENDS[name])}</robot>'
    assert any(each.is_error for each in twinform.check(text.encode(), name="r.urdf").diagnostics)
