"""DOT, as Graphviz reads it."""

import json
import shutil
import subprocess
from typing import Any

import pytest

from twinform.compiler.graph import Graph
from twinform.compiler.graph.graph import shortened
from twinform.compiler.graph.languages import dot, quoted

from .models import HOSTILE, NESTED, WORLD, hostile_urdf
from .test_graph import graph_of

_GRAPHVIZ = shutil.which("dot")
needs_graphviz = pytest.mark.skipif(_GRAPHVIZ is None, reason="Graphviz is not installed: apt-get install graphviz")


def _read(graph: Graph) -> Any:
    """What Graphviz understands, after its layout, which is what makes texts of labels."""
    assert _GRAPHVIZ
    command = [_GRAPHVIZ, "-Tjson"]
    done = subprocess.run(command, input=dot(graph).encode(), capture_output=True, check=True, timeout=30)
    assert not done.stderr
    return json.loads(done.stdout)


def _texts(part: dict[str, Any]) -> list[str]:
    return [step["text"] for step in part.get("_ldraw_", ()) if step["op"] == "T"]


@needs_graphviz
def test_graphviz_finds_every_node_edge_and_cluster() -> None:
    graph = graph_of(NESTED, frames=True, mimics=True)
    found = _read(graph)
    names = [each["name"] for each in found["objects"]]
    nodes = [*(node.id for node in graph.nodes), *(joint.id for joint in graph.joints)]
    assert sorted(names) == sorted(["cluster_c1", *nodes])
    assert len(found["edges"]) == 2 * len(graph.joints) + len(graph.attachments) + len(graph.followers)
    (hand,) = (each for each in found["objects"] if each["name"] == "cluster_c1")
    assert _texts(hand) == ["hand"]
    assert {names[index] for index in hand["nodes"]} >= {"n3", "n4"}


@needs_graphviz
def test_graphviz_draws_the_models_of_a_world() -> None:
    found = _read(graph_of(WORLD))
    labels = {each["name"]: _texts(each) for each in found["objects"]}
    assert (labels["cluster_c0"], labels["cluster_c1"], labels["cluster_c2"]) == (["yard"], ["a"], ["b"])


@needs_graphviz
def test_graphviz_shows_hostile_names_as_they_are() -> None:
    graph = graph_of(hostile_urdf())
    drawn = {each["name"]: _texts(each) for each in _read(graph)["objects"]}
    for node in graph.nodes:
        assert drawn[node.id] == [shortened(node.label)]
    for joint in graph.joints:
        assert drawn[joint.id] == [shortened(joint.label), "fixed"]


def test_no_name_ends_its_string() -> None:
    for name in HOSTILE:
        inside = quoted(name)[1:-1].replace("\\\\", "").replace('\\"', "")
        assert '"' not in inside
        assert not inside.endswith("\\")
        assert "\n" not in inside
