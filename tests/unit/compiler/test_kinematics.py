"""Forward kinematics, before Pinocchio and by hand."""

import importlib
import math
import random
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given

import twinform
from twinform.compiler.kinematics import Leader, Positions
from twinform.compiler.scene import Scene, build_scene
from twinform.ir import Document
from twinform.ir.transform import Transform
from twinform.testing import oracles
from twinform.testing.strategies import robots

needs_pinocchio = pytest.mark.skipif(not oracles.available("pinocchio"), reason="Pinocchio is not installed")
_ONE_DEGREE = {"revolute", "continuous", "prismatic"}


@needs_pinocchio
@given(robots())
def test_links_are_where_pinocchio_says(document: Document) -> None:
    pinocchio: Any = importlib.import_module("pinocchio")
    model = pinocchio.buildModelFromXML(twinform.dumps(document))
    scene = build_scene(document)
    positions = _positions(scene)
    data, q = model.createData(), pinocchio.neutral(model)
    kinematics = scene.kinematics()
    for joint in scene.joints:
        if joint.type in _ONE_DEGREE and model.existJointName(joint.name):
            position = kinematics.position(joint.name, 0, positions)
            _put(q, model.joints[model.getJointId(joint.name)], position)
    pinocchio.framesForwardKinematics(model, data, q)
    poses = kinematics.poses(positions)
    for frame in model.frames:
        if frame.type == pinocchio.FrameType.BODY and frame.name in poses:
            found = data.oMf[model.getFrameId(frame.name, frame.type)].homogeneous
            np.testing.assert_allclose(poses[frame.name].matrix, found, atol=1e-9 * (1 + np.abs(found).max()))


def _positions(scene: Scene) -> Positions:
    random_ = random.Random(1)
    moving = [joint for joint in scene.joints if joint.type in _ONE_DEGREE and joint.degrees[0].leader is None]
    return {(joint.name, 0): random_.uniform(-1, 1) for joint in moving}


def _put(q: Any, joint: Any, value: float) -> None:
    """A joint without limits is a point on a circle to Pinocchio."""
    if joint.nq == 1:
        q[joint.idx_q] = value
    elif joint.nq == 2 and joint.nv == 1:
        q[joint.idx_q : joint.idx_q + 2] = math.cos(value), math.sin(value)


_SDF = """<sdf version="1.11"><model name="m">
  <link name="a"/><link name="b"><pose>1 0 0 0 0 0</pose></link>
  <joint name="j" type="{type}"><parent>a</parent><child>b</child>{more}</joint>
</model></sdf>"""


def _moved(type: str, more: str, positions: dict[tuple[str, int], float]) -> Transform:
    scene = build_scene(twinform.loads(_SDF.format(type=type, more=more)))
    return scene.kinematics().poses(positions)["b"]


@pytest.mark.parametrize(
    ("type", "more", "positions", "translation", "rpy"),
    [
        ("revolute", "<axis><xyz>0 0 1</xyz></axis>", {("j", 0): 0.5}, (1, 0, 0), (0, 0, 0.5)),
        ("prismatic", "<axis><xyz>0 1 0</xyz></axis>", {("j", 0): 0.5}, (1, 0.5, 0), (0, 0, 0)),
        ("revolute", "<pose>-1 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis>", {("j", 0): math.pi / 2}, (0, 1, 0),
         (0, 0, math.pi / 2)),
        ("ball", "", {("j", 1): 0.5}, (1, 0, 0), (0, 0.5, 0)),
        ("ball", "", {("j", 2): 0.5, ("j", 0): 0.25}, (1, 0, 0), None),
        ("universal", "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>", {("j", 1): 0.5}, (1, 0, 0),
         (0, 0.5, 0)),
        ("revolute2", "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>", {("j", 0): 0.25}, (1, 0, 0),
         (0, 0, 0.25)),
        ("screw", "<axis><xyz>0 0 1</xyz></axis><screw_thread_pitch>0.2</screw_thread_pitch>",
         {("j", 0): math.pi}, (1, 0, 0.1), None),
        ("fixed", "", {("j", 0): 0.5}, (1, 0, 0), (0, 0, 0)),
    ],
)  # fmt: skip
def test_each_type_of_joint_moves_as_it_is_defined(
    type: str, more: str, positions: dict[tuple[str, int], float], translation: Any, rpy: Any
) -> None:
    pose = _moved(type, more, positions)
    assert pose.translation == pytest.approx(translation, abs=1e-12)
    if rpy is not None:
        assert pose.rpy() == pytest.approx(rpy, abs=1e-12)


def test_followers_follow_and_circles_stand_still() -> None:
    mimic = '<mimic joint="{}"><multiplier>2</multiplier><offset>0.1</offset><reference>0.05</reference></mimic>'
    text = """<sdf version="1.11"><model name="m"><link name="a"/><link name="b"/><link name="c"/>
      <joint name="one" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>{}</axis></joint>
      <joint name="two" type="revolute"><parent>b</parent><child>c</child><axis><xyz>0 0 1</xyz>{}</axis></joint>
    </model></sdf>"""
    follows = build_scene(twinform.loads(text.format("", mimic.format("one")))).kinematics()
    assert follows.position("two", 0, {("one", 0): 0.25}) == pytest.approx(2 * (0.25 - 0.05) + 0.1)
    assert follows.poses({("one", 0): 0.25})["c"].rpy()[2] == pytest.approx(0.25 + 0.5)
    document = build_scene(twinform.loads(text.format("", "")))
    one, two = document.joints
    circle = Scene(document.links, (_following(one, "two"), _following(two, "one")))
    assert circle.kinematics().position("one", 0, {}) == 0.0


def _following(joint: Any, leader: str) -> Any:
    (degree,) = joint.degrees
    return replace(joint, degrees=(replace(degree, leader=Leader(leader, 0, 1.0, 0.0, 0.0)),))


def test_a_planar_joint_slides_in_its_plane_and_turns() -> None:
    text = """<robot name="r"><link name="a"/><link name="b"/>
      <joint name="j" type="planar"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"""
    kinematics = build_scene(twinform.loads(text)).kinematics()
    pose = kinematics.poses({("j", 0): 0.5, ("j", 1): -0.25, ("j", 2): 0.75})["b"]
    assert pose.translation == pytest.approx((0.5, -0.25, 0))
    assert pose.rpy() == pytest.approx((0, 0, 0.75))
