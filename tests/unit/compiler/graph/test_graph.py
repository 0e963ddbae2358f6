"""What is in a graph: nodes, joints between them, clusters, frames and mimics."""

from twinform.compiler import check
from twinform.compiler.graph import Graph, build_graph

from .models import NESTED, WORLD


def graph_of(text: str, **options: bool) -> Graph:
    """The graph of a model that may have errors."""
    document = check(text.encode()).document
    assert document is not None
    return build_graph(document, **options)


def _joints(graph: Graph) -> set[tuple[str, str, str]]:
    names = {node.id: node.name for node in graph.nodes}
    return {(joint.name, names[joint.parent], names[joint.child]) for joint in graph.joints}


def test_links_and_joints_of_nested_models() -> None:
    graph = graph_of(NESTED)
    assert [node.name for node in graph.nodes] == ["base", "arm", "hand::palm", "hand::thumb"]
    assert _joints(graph) == {
        ("shoulder", "base", "arm"),
        ("wrist", "arm", "hand::palm"),
        ("loop", "base", "hand::thumb"),
        ("hand::thumb_joint", "hand::palm", "hand::thumb"),
    }
    assert [(each.name, each.inside) for each in graph.clusters] == [("robot", None), ("hand", "c0")]
    assert graph.title == "robot"
    assert graph.summary() == "4 links, 4 joints"


def test_a_joint_hangs_from_the_frame_that_it_names_where_frames_are_shown() -> None:
    graph = graph_of(NESTED, frames=True)
    assert ("wrist", "tool", "hand::palm") in _joints(graph)
    names = {node.id: node.name for node in graph.nodes}
    assert {(names[each.frame], names[each.to]) for each in graph.attachments} == {
        ("tool", "arm"),
        ("hand::grasp", "hand::thumb"),
    }


def test_limits_are_in_the_details_with_their_units() -> None:
    details = {joint.name: joint.details for joint in graph_of(NESTED).joints}
    assert details["hand::thumb_joint"] == ("-0.5 to 1.25 rad",)
    assert details["shoulder"] == ("0 to 0.4 m",)
    assert details["loop"] == ()


def test_two_axes_have_two_ranges_and_half_a_range_says_which_half() -> None:
    graph = graph_of(
        '<sdf version="1.11"><model name="m"><link name="a"/><link name="b"/>'
        '<joint name="j" type="universal"><parent>a</parent><child>b</child>'
        "<axis><xyz>1 0 0</xyz><limit><lower>-1</lower></limit></axis>"
        "<axis2><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis2></joint></model></sdf>"
    )
    assert graph.joints[0].details == ("from -1 rad", "-1 to 2 rad")


def test_a_continuous_joint_has_no_limits() -> None:
    graph = graph_of(
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/>'
        '<child link="b"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>'
    )
    assert graph.joints[0].details == ()


def test_mimics_lead_to_the_leader_and_to_one_that_is_missing() -> None:
    graph = graph_of(NESTED, mimics=True)
    (follower,) = graph.followers
    names = {each.id: each.name for each in (*graph.nodes, *graph.joints)}
    assert names[follower.joint] == "hand::thumb_joint"
    assert follower.detail == "multiplier -2, offset 0.1"
    assert next(node for node in graph.nodes if node.id == follower.leader).kind == "missing"
    assert not graph_of(NESTED).followers


def test_the_models_of_a_world_are_clusters_in_it() -> None:
    graph = graph_of(WORLD)
    assert [(each.kind, each.name, each.inside) for each in graph.clusters] == [
        ("world", "yard", None),
        ("model", "a", "c0"),
        ("model", "b", "c0"),
    ]
    assert _joints(graph) == {("held", "world", "a::l"), ("tied", "a::l", "b::l"), ("put", "b::l", "box")}
    assert {node.name: node.kind for node in graph.nodes}["box"] == "include"


def test_what_is_named_and_not_there_is_a_missing_node_once() -> None:
    graph = graph_of(
        '<robot name="r"><link name="a"/>'
        '<joint name="j" type="fixed"><parent link="gone"/><child link="a"/></joint>'
        '<joint name="k" type="fixed"><parent link="a"/><child link="gone"/></joint></robot>'
    )
    assert [(node.kind, node.label) for node in graph.nodes] == [("link", "a"), ("missing", "gone")]


def test_a_joint_of_a_gazebo_element_closes_a_loop() -> None:
    graph = graph_of(
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
        '<gazebo><joint name="loop" type="ball"><parent>a</parent><child>b</child></joint></gazebo></robot>'
    )
    assert [joint.name for joint in graph.joints] == ["j", "loop"]


def test_a_link_and_a_joint_of_one_name_are_two() -> None:
    graph = graph_of(
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="b" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    assert _joints(graph) == {("b", "a", "b")}


def test_an_empty_world_is_an_empty_graph() -> None:
    graph = graph_of('<sdf version="1.11"><world name="w"/></sdf>')
    assert (graph.nodes, graph.joints, graph.summary()) == ((), (), "no links")


def test_a_link_of_urdf_that_is_called_world_is_a_link() -> None:
    graph = graph_of(
        '<robot name="r"><link name="world"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="world"/><child link="b"/></joint></robot>'
    )
    assert [(node.kind, node.name) for node in graph.nodes] == [("link", "world"), ("link", "b")]
