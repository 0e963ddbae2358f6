"""Lookups: links and joints by name, parents and children, chains; in nested models, worlds and loops too."""

import pytest
from hypothesis import given

import twinform
from testbed.corpus.files import ROOT
from twinform.ir import Document, Model
from twinform.ir.frames import FrameError
from twinform.ir.kinematic_tree import KinematicTree
from twinform.testing.strategies import robots, sdf_models

NESTED = """<sdf version="1.11"><model name="outer">
  <link name="base"/>
  <frame name="mount" attached_to="base"/>
  <model name="inner"><link name="a"/><link name="b"/>
    <joint name="j" type="fixed"><parent>a</parent><child>b</child></joint></model>
  <joint name="holds" type="fixed"><parent>mount</parent><child>inner::a</child></joint>
  <joint name="stands" type="fixed"><parent>world</parent><child>base</child></joint>
</model></sdf>"""
LOOP = """<sdf version="1.11"><model name="loop"><link name="a"/><link name="b"/><link name="c"/>
  <joint name="ab" type="fixed"><parent>a</parent><child>b</child></joint>
  <joint name="bc" type="fixed"><parent>b</parent><child>c</child></joint>
  <joint name="ca" type="fixed"><parent>c</parent><child>a</child></joint>
</model></sdf>"""
WORLD = """<sdf version="1.11"><world name="w">
  <model name="m"><link name="l"/></model><model name="n"><link name="l"/></model>
  <joint name="j" type="fixed"><parent>m::l</parent><child>n::l</child></joint>
</world></sdf>"""


def _tree(text: str) -> KinematicTree:
    document = twinform.loads(text)
    return KinematicTree((*document.worlds, *document.models)[0])


def test_a_robot_of_urdf_is_one_tree():
    tree = KinematicTree(twinform.load(ROOT / "examples/rover.urdf").models[0])
    assert tree.roots == ("base_footprint",)
    assert tree.parent("base_footprint") is None
    assert tree.parent("imu_link") == "base_link"
    assert "imu_link" in tree.children("base_link")
    assert [each.name for each in tree.chain("base_footprint", "imu_link")] == ["base_footprint_joint", "imu_joint"]
    assert tree.link("imu_link").name == "imu_link"
    assert tree.joint("imu_joint").child == "imu_link"
    assert tree.closing == ()


def test_names_and_frames_of_nested_models_are_resolved():
    tree = _tree(NESTED)
    assert [*tree.links] == ["base", "inner::a", "inner::b"]
    assert [*tree.joints] == ["holds", "stands", "inner::j"]
    assert tree.children("world") == ("base",)
    assert tree.roots == ("base",)
    assert tree.parent("inner::a") == "base"
    assert [*tree.below("base")] == ["base", "inner::a", "inner::b"]
    assert tree.frames.pose("inner::b", "base").translation == (0, 0, 0)


def test_what_closes_a_loop_is_told_apart():
    tree = _tree(LOOP)
    assert len(tree.closing) == 1
    assert sorted(tree.below(tree.roots[0])) == ["a", "b", "c"]


def test_a_joint_around_a_nested_model_closes_its_loop():
    tree = _tree("""<sdf version="1.11"><model name="m"><link name="base"/>
        <joint name="a_pin" type="ball"><parent>base</parent><child>inner::tip</child></joint>
        <model name="inner"><link name="root"/><link name="tip"/>
          <joint name="slide" type="prismatic"><parent>root</parent><child>tip</child></joint></model>
        <joint name="a_weld" type="fixed"><parent>base</parent><child>inner::root</child></joint></model></sdf>""")
    assert [each.name for each in tree.closing] == ["a_pin"]
    assert tree.roots == ("base",)


def test_joints_of_a_world_hold_its_models_together():
    tree = _tree(WORLD)
    assert tree.chain("m::l", "n::l")[0].joint.name == "j"
    assert tree.roots == ("m::l",)


def test_a_link_of_urdf_may_be_called_world():
    tree = _tree(
        '<robot name="r"><link name="world"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="world"/><child link="b"/></joint></robot>'
    )
    assert tree.roots == ("world",)
    assert tree.parent("world") is None
    assert tree.children("world") == ("b",)


@pytest.mark.parametrize("ask", ["link", "parent", "children", "joint_above", "joints_below"])
def test_a_name_that_is_not_there_is_an_error(ask: str):
    with pytest.raises(KeyError, match=r"there is no link 'bse'; did you mean 'base'\?"):
        getattr(_tree(NESTED), ask)("bse")


def test_a_tip_that_does_not_hang_from_the_base_is_an_error():
    with pytest.raises(ValueError, match="'base' does not hang from 'inner::b'"):
        _tree(NESTED).chain("inner::b", "base")
    with pytest.raises(KeyError):
        list(_tree(NESTED).below("none"))


def test_an_end_that_is_not_known_is_an_error():
    model = twinform.loads(NESTED).models[0]
    broken = model.copy(frames=())
    with pytest.raises(FrameError, match="mount"):
        KinematicTree(broken)


def test_a_model_without_links_is_an_empty_tree():
    tree = KinematicTree(Model(name="none"))
    assert (tree.roots, tree.closing, dict(tree.links)) == ((), (), {})


@pytest.mark.slow
@given(robots() | sdf_models())
def test_every_link_is_below_exactly_one_root(document: Document):
    tree = KinematicTree(document.models[0])
    assert sorted(link for root in tree.roots for link in tree.below(root)) == sorted(tree.links)
    for link in tree.links:
        parent = tree.parent(link)
        assert parent is None or link in tree.children(parent)
        assert next(root for root in tree.roots if link in tree.below(root))
