"""Bodies in MJCF: chains as deep as MuJoCo reads, and names that are unique in the file."""

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.compiler import CompileError
from twinform.passes.legalise.to_mjcf.bodies import MOST_DEEP


def _chain(count: int) -> bytes:
    links = "".join(f'<link name="l{i}">{INERTIAL}</link>' for i in range(count))
    joints = "".join(
        f'<joint name="j{i}" type="continuous"><parent link="l{i - 1}"/><child link="l{i}"/></joint>'
        for i in range(1, count)
    )
    return f'<robot name="chain">{links}{joints}</robot>'.encode()


def test_a_chain_as_long_as_mujoco_reads_is_written() -> None:
    assert twinform.convert(_chain(MOST_DEEP), to="mjcf").text.count("<body") == MOST_DEEP


def test_a_longer_chain_is_refused_with_what_helps() -> None:
    with pytest.raises(CompileError) as refused:
        twinform.convert(_chain(MOST_DEEP + 1), to="mjcf")
    (error,) = (each for each in refused.value.diagnostics if each.is_error)
    assert error.rule.name == "nested-too-deeply"
    assert "lump-fixed-joints" in (error.help or "")


def test_a_geom_that_is_seen_and_touched_stays_in_the_group_that_viewers_show() -> None:
    seen = '<geom name="s" type="sphere" size="2" contype="0" conaffinity="0" density="0"/>'
    body = f'<body><geom name="g" type="box" size="1 1 1"/>{seen}</body>'
    read = twinform.convert(f"<mujoco><worldbody>{body}</worldbody></mujoco>".encode(), to="sdf").text
    assert "same-geom" in read
    again = twinform.convert(read.encode(), to="mjcf").text
    assert '<geom name="g" type="box" size="1 1 1"/>' in again
    assert "group=" not in again


def test_many_parts_of_one_name_are_told_apart() -> None:
    visual = '<visual name="seen"><geometry><sphere><radius>1</radius></sphere></geometry></visual>'
    links = "".join(f'<link name="l{i}">{visual}</link>' for i in range(3))
    text = twinform.convert(f'<sdf version="1.11"><model name="m">{links}</model></sdf>'.encode(), to="mjcf").text
    assert [f'<geom name="{name}"' in text for name in ("seen", "l1_seen", "l2_seen")] == [True, True, True]
