"""Mermaid: every line is one of a few forms, and no name can leave its label. `tests/browser` has Mermaid read it."""

import re

from tests.chains import chain
from twinform.compiler.graph import Graph, GraphNode
from twinform.compiler.graph.languages import MOST_EDGES, escaped, fits, mermaid

from .models import HOSTILE, NESTED, WORLD, hostile_urdf
from .test_graph import graph_of

_LABEL = r'"(?:[\w .,/()-]|#\d+;|<br>)+"'
_LINE = re.compile(
    rf"flowchart TD|end|subgraph c\d+\[{_LABEL}\]|classDef missing [\w:#, -]+"
    rf"|n\d+(?:\[{_LABEL}\](?::::missing)?|\{{\{{{_LABEL}\}}\}}|\[\[{_LABEL}\]\]|\[/{_LABEL}/\])"
    rf"|j\d+\(\[{_LABEL}\]\)|n\d+ --- j\d+ --> n\d+|n\d+ -\.- n\d+|j\d+ -\. {_LABEL} \.-> [nj]\d+"
)


def _are_all_forms(text: str) -> bool:
    return all(_LINE.fullmatch(line.strip()) for line in text.splitlines())


def test_a_nested_model_is_a_subgraph() -> None:
    text = mermaid(graph_of(NESTED, frames=True, mimics=True))
    assert _are_all_forms(text)
    assert '  subgraph c1["hand"]\n    n3["palm"]' in text
    assert 'j0(["shoulder<br>prismatic<br>0 to 0.4 m"])' in text
    assert '-. "mimics, multiplier -2, offset 0.1" .->' in text
    assert text.count("subgraph") == text.count("\n  end\n") == 1


def test_a_world_is_a_subgraph_with_its_models_in_it() -> None:
    text = mermaid(graph_of(WORLD))
    assert _are_all_forms(text)
    assert '  subgraph c0["yard"]\n' in text
    assert '    subgraph c1["a"]\n' in text
    assert '[/"box"/]' in text


def test_hostile_names_stay_in_their_labels() -> None:
    text = mermaid(graph_of(hostile_urdf()))
    assert _are_all_forms(text)
    assert len(text) < 10_000
    assert "#34;" in text
    assert "#60;script#62;" in text


def test_escapes_mean_the_name_again() -> None:
    for name in HOSTILE:
        if name.isprintable() and len(name) < 60:
            assert re.sub(r"#(\d+);", lambda found: chr(int(found[1])), escaped(name)) == name


def test_what_is_too_large_for_the_usual_settings_is_known() -> None:
    assert fits(graph_of(NESTED), mermaid(graph_of(NESTED)))
    large = graph_of(chain(MOST_EDGES))
    assert not fits(large, mermaid(large))


def test_a_node_without_a_name_has_a_label() -> None:
    assert 'n0[" "]' in mermaid(Graph("", nodes=(GraphNode("n0", "link", "", ""),)))


def test_a_name_without_end_fits() -> None:
    """No file has one of more than 1,024 characters, and documents in memory may."""
    text = mermaid(Graph("", nodes=(GraphNode("n0", "link", "x" * 10_000, "x" * 10_000),)))
    assert f'n0["{"x" * 40}#8230;' in text
    assert len(text) < 500
