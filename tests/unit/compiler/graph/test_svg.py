"""SVG: it is XML, names are text, and boxes do not lie on each other."""

from itertools import combinations

from lxml import etree

from tests.chains import chain
from twinform.compiler.graph import Graph
from twinform.compiler.graph.graph import shortened
from twinform.compiler.graph.layout import LayoutBox, layout
from twinform.compiler.graph.svg import svg

from .models import NESTED, WORLD, hostile_urdf
from .test_graph import graph_of

_SVG = "{http://www.w3.org/2000/svg}"


def _texts(graph: Graph) -> list[str]:
    root = etree.fromstring(svg(graph).encode())
    return [each.text or "" for each in root.iter(f"{_SVG}text")]


def _overlap(one: LayoutBox, other: LayoutBox) -> bool:
    return one.x < other.right and other.x < one.right and one.y < other.bottom and other.y < one.bottom


def test_it_has_a_title_and_a_description() -> None:
    root = etree.fromstring(svg(graph_of(NESTED)).encode())
    assert root.get("role") == "img"
    title, about = root[0], root[1]
    assert (title.tag, title.text) == (f"{_SVG}title", "robot")
    assert root.get("aria-labelledby") == f"{title.get('id')} {about.get('id')}"
    assert (about.text or "").startswith("4 links, 4 joints. shoulder, prismatic, from base to arm.")


def test_links_joints_limits_and_mimics_are_text() -> None:
    texts = _texts(graph_of(NESTED, frames=True, mimics=True))
    assert {"base", "shoulder", "prismatic, 0 to 0.4 m", "tool", "hand"} <= set(texts)
    assert "mimics wave, multiplier -2, offset 0.1" in texts


def test_hostile_names_are_nothing_but_text() -> None:
    graph = graph_of(hostile_urdf())
    text = svg(graph)
    root = etree.fromstring(text.encode())
    tags = {str(each.tag).removeprefix(_SVG) for each in root.iter()}
    assert tags <= {"svg", "title", "desc", "style", "rect", "text", "g", "path"}
    assert not any(
        name.startswith("on") or name.endswith("href") for each in root.iter() for name in map(str, each.keys())
    )
    assert {shortened(node.label) for node in graph.nodes} <= set(_texts(graph))
    assert len(text) < 60_000


def test_nothing_is_loaded_from_elsewhere() -> None:
    text = svg(graph_of(WORLD)).replace("http://www.w3.org/2000/svg", "")
    assert not any(word in text for word in ("http", "url(", "@import", "<script", "<image"))


def test_boxes_are_apart_and_children_are_to_the_right() -> None:
    for text in (NESTED, WORLD):
        places = layout(graph_of(text, frames=True))
        assert not any(_overlap(a, b) for a, b in combinations(places.boxes.values(), 2))
        for hold in places.holds:
            assert places.boxes[hold.parent].right < places.boxes[hold.child].x


def test_the_frame_of_a_cluster_holds_its_nodes_and_no_others() -> None:
    for text in (NESTED, WORLD):
        graph = graph_of(text, frames=True)
        places = layout(graph)
        above = {cluster.id: cluster.inside for cluster in graph.clusters}
        assert places.clusters
        for node in graph.nodes:
            around: set[str | None] = set()
            cluster = node.cluster
            while cluster:
                around.add(cluster)
                cluster = above[cluster]
            for each, box in places.clusters.items():
                assert _overlap(box, places.boxes[node.id]) == (each in around), (node.name, each)


def test_a_joint_that_closes_a_loop_is_drawn_across() -> None:
    graph = graph_of(NESTED)
    assert [joint.name for joint in layout(graph).across] == ["loop"]
    assert any("loop" in text for text in _texts(graph))


def test_circles_have_a_drawing() -> None:
    graph = graph_of(
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>'
        '<joint name="l" type="fixed"><parent link="a"/><child link="a"/></joint></robot>'
    )
    assert {"j", "k \N{EM DASH} fixed", "l \N{EM DASH} fixed"} <= set(_texts(graph))


def test_a_long_chain_is_no_recursion() -> None:
    assert len(_texts(graph_of(chain(3000)))) == 2 + 3000 + 2 * 2999


def test_a_model_without_anything_has_a_drawing() -> None:
    assert _texts(graph_of('<sdf version="1.11"><world name="w"/></sdf>')) == ["w", "no links"]
