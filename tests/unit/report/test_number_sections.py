"""How far links are from their roots, and can be."""

import math

import twinform
from twinform.compiler.scene import build_scene
from twinform.report.number_sections import reaches

_ARM = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="j" type="revolute"><origin xyz="3 0 0"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
  <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="{type}"><origin xyz="0 4 0"/><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
  <limit lower="-2" upper="1" effort="1" velocity="1"/></joint>
<joint name="l" type="fixed"><parent link="c"/><child link="d"/></joint></robot>"""


def _of(text: str) -> dict[str, tuple[float, float]]:
    return {each.link: (each.zero, each.most) for each in reaches(build_scene(twinform.loads(text.encode())))}


def test_distances_add_up_along_the_joints() -> None:
    assert _of(_ARM.format(type="revolute")) == {"b": (3, 3), "c": (5, 7), "d": (5, 7)}


def test_a_joint_that_slides_adds_its_travel() -> None:
    assert _of(_ARM.format(type="prismatic"))["d"] == (5, 9)


def test_one_that_slides_without_an_end_reaches_everywhere() -> None:
    text = """<sdf version="1.11"><model name="m"><link name="a"/><link name="b"/><joint name="j" type="prismatic">
    <parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"""
    assert _of(text)["b"] == (0, math.inf)


def test_a_circle_ends() -> None:
    text = """<sdf version="1.11"><model name="m"><link name="a"/><link name="b"><pose>1 0 0 0 0 0</pose></link>
    <joint name="j" type="ball"><parent>a</parent><child>b</child></joint>
    <joint name="k" type="ball"><parent>b</parent><child>a</child></joint></model></sdf>"""
    assert _of(text) == {"b": (1, 1)}
