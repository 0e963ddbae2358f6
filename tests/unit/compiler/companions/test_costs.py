"""Companion files that were made to cost much: they cost no more than their size."""

import time
from collections.abc import Callable
from pathlib import Path

import pytest

from twinform.compiler.companions.check_companion import check_companion
from twinform.compiler.input.load_options import LoadOptions

pytestmark = pytest.mark.slow
_COUNT = 8_000
_LINKS = "".join(f'<link name="l{n}"/>' for n in range(_COUNT))


def _srdf(each: Callable[[int], str]) -> str:
    return f'<robot name="r">{"".join(map(each, range(_COUNT)))}</robot>'


_HOSTILE = {
    "pairs.srdf": _srdf(lambda n: f'<disable_collisions link1="l{n}" link2="x{n}"/>'),
    "twice.srdf": _srdf(lambda _: '<disable_collisions link1="l1" link2="l2"/>'),
    "groups.srdf": _srdf(lambda n: f'<group name="g{n}"><group name="g{n + 1}"/></group>'),
    "hub.srdf": _srdf(lambda n: f'<group name="g{n}"><group name="hub"/></group>').replace(
        "</robot>", f'<group name="hub">{"".join(f"<group name={chr(34)}g{n}{chr(34)}/>" for n in range(_COUNT))}'
    )
    + "</group></robot>",
    "chains.srdf": _srdf(lambda n: f'<group name="g"><chain base_link="l0" tip_link="l{n}"/></group>'),
    "virtual.srdf": _srdf(lambda n: f'<virtual_joint name="v{n}" type="x" child_link="l{n}"/>'),
    "states.srdf": _srdf(lambda n: f'<group_state name="s" group="g"><joint name="j{n}" value="9"/></group_state>'),
    "deep.srdf": f'<robot name="r">{"<group>" * 200}{"</group>" * 200}</robot>',
    "names.yaml": "n:\n  ros__parameters:\n    joints: [" + ", ".join(f"j{n}x" for n in range(3 * _COUNT)) + "]\n",
    "made.yaml": "n:\n  ros__parameters:\n    joints: [" + ", ".join(f"$(var p)j{n}x" for n in range(_COUNT)) + "]\n",
    "comments.yaml": "# twinform: allow stale-name\n" * _COUNT + "base_frame_id: none\n",
    "keys.yaml": "base_frame_id: l1\n" * (2 * _COUNT),
    "dots.yaml": f"n:\n  ros__parameters:\n    base_frame_id: l1\n    {'a.' * 30}b: 1\n" * 500,
}


@pytest.mark.parametrize("name", _HOSTILE)
def test_a_hostile_file_costs_no_more_than_its_size(name: str, tmp_path: Path) -> None:
    joints = "".join(
        f'<joint name="j{n}" type="fixed"><parent link="l{n}"/><child link="l{n + 1}"/></joint>'
        for n in range(_COUNT - 1)
    )
    (tmp_path / "r.urdf").write_text(f'<robot name="r">{_LINKS}{joints}</robot>', encoding="utf-8")
    path = tmp_path / name
    path.write_text(_HOSTILE[name], encoding="utf-8")
    options = LoadOptions()
    check_companion(path, options)  # reads the robot
    started = time.process_time()
    check_companion(path, options)
    assert time.process_time() - started < 4
