"""Robots whose joints connect any links, in loops and in several trees: every walk along joints comes to an end."""

import random
import re

import twinform
from testbed.corpus.files import ROOT
from tests.profile import DEEP
from twinform.compiler import LoadOptions
from twinform.compiler.fixing import apply_fixes
from twinform.compiler.workers import Failure, run

_ROBOTS = ("tests/mistakes/porter_description/urdf/porter.urdf", "examples/rover.urdf", "examples/four_wheels.urdf")
_EVERY_CONSUMER = "gazebo,moveit,kdl,drake,mujoco,pybullet,urdfdom"
_NUMBER = 300 if DEEP else 30
_SECONDS = 20


def _tangled(seed: int) -> str:
    """A robot with other ends of joints, more fixed joints, and fewer masses, so that more links are lumped."""
    chosen = random.Random(seed)
    text = (ROOT / chosen.choice(_ROBOTS)).read_text("utf-8")
    links = re.findall(r'<link name="([^"]+)"', text)

    def sometimes(share: float, pattern: str, new: str) -> None:
        nonlocal text
        text = re.sub(pattern, lambda found: found[0] if chosen.random() > share else found.expand(new), text)

    for link in chosen.sample(links, len(links) // 2):
        sometimes(0.1, r'<(parent|child) link="[^"]*"', rf'<\1 link="{link}"')
    sometimes(0.3, r'type="(?:revolute|continuous|prismatic)"', 'type="fixed"')
    sometimes(0.2, r"(?s)<inertial>.*?</inertial>", "")
    return text


def _judge(seed: int) -> int:
    data = _tangled(seed).encode()
    twinform.check(data, passes="check-inertia,check-limits,check-plugins")
    twinform.check(data, profiles=_EVERY_CONSUMER)
    return len(apply_fixes(data, LoadOptions(), unsafe=True).applied)


def test_a_robot_with_any_joints_is_judged_and_fixed_in_time() -> None:
    answers = dict(run(_judge, range(_NUMBER), seconds=_SECONDS, processes=1))
    assert {seed: each.cause for seed, each in answers.items() if isinstance(each, Failure)} == {}
    assert len({_tangled(seed) for seed in range(_NUMBER)}) == _NUMBER
