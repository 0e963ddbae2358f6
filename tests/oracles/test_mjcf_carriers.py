"""Carriers in MJCF in the hands of MuJoCo: it keeps them when it saves a model, and when it attaches one to another."""

from pathlib import Path
from random import Random
from typing import Any

import pytest

from testbed.edits import draw_edits
from testbed.edits.judging import judge_edits, unedited
from tests.profile import examples
from tests.snippets import ARM
from twinform.compiler import convert

mujoco: Any = pytest.importorskip("mujoco")
pytest.importorskip("numpy")

_CASES = Path("tests/cases")
_BESIDE_JOINTS = b"""\
<transmission name="drive"><type>simple</type><joint name="wrist"/><actuator name="motor"/></transmission>
<gazebo><plugin name="p" filename="q"><text>two
lines &lt; three</text></plugin></gazebo>
</robot>"""
_ARM = ARM.replace(b"</robot>", _BESIDE_JOINTS)


def test_what_mujoco_saves_comes_home() -> None:
    saved = mujoco.MjSpec.from_string(convert(_ARM, to="mjcf").text)
    saved.compile()
    back = convert(saved.to_xml().encode(), to="urdf").text
    assert back == convert(convert(_ARM, to="mjcf").text.encode(), to="urdf").text
    assert all(each in back for each in ('velocity="3"', 'k_velocity="4"', "<transmission", "two\nlines"))


def test_what_is_attached_keeps_what_belongs_to_its_joints() -> None:
    whole = mujoco.MjSpec()
    part = mujoco.MjSpec.from_string(convert(_ARM, to="mjcf").text)
    for side in ("left_", "right_"):
        whole.attach(part.copy(), prefix=side, frame=whole.worldbody.add_frame(pos=(len(side), 0, 0)))
    whole.compile()
    back = convert(whole.to_xml().encode(), to="sdf").text
    assert back.count("<velocity>3</velocity>") == len(("left", "right"))


_EDITED = (
    "convert/ball_and_screw.sdf",
    "convert/universal_joint.sdf",
    "edits/nested.sdf",
    "companions/lifter/lifter_description/urdf/lifter.urdf",
    "whole/links.sdf",
)


@pytest.mark.parametrize("name", _EDITED)
def test_edits_of_mjcf_win(name: str) -> None:
    source = _CASES / name
    before = unedited(convert(source, to="mjcf").text.encode(), "urdf" if source.suffix == ".urdf" else "sdf")
    assert not before.not_read
    assert before.differing_in_engines == ()
    for seed in range(examples(0.2).max_examples):
        edits, edited = draw_edits(before.text, Random(seed))
        verdict = judge_edits(before, edits, edited)
        assert not verdict.is_fault, "\n".join((*map(str, edits), *verdict.differences))


def test_no_condim_is_written_that_mujoco_refuses() -> None:
    source = (_CASES / "from_mjcf/friction.expected.sdf").read_bytes()
    assert b'condim="6"' in source
    made = convert(source.replace(b'condim="6"', b'condim="5"'), to="mjcf")
    mujoco.MjModel.from_xml_string(made.text)
    assert "stale-carrier" in {each.rule.name for each in made.diagnostics}
