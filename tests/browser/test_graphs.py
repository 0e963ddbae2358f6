"""Graphs in a browser: SVG that shows and asks for nothing, and Mermaid as Mermaid draws it."""

import os
from pathlib import Path

import pytest

from tests.unit.compiler.graph.models import NESTED, WORLD, hostile_urdf
from tests.unit.compiler.graph.test_graph import graph_of
from twinform.compiler.graph import Graph
from twinform.compiler.graph.graph import shortened
from twinform.compiler.graph.languages import mermaid
from twinform.compiler.graph.svg import svg

from .watched import Watched

_MODULES = Path(os.environ.get("TWINFORM_NODE_MODULES", Path(__file__).parents[2] / "out/readers/node_modules"))
_MERMAID = _MODULES / "mermaid/dist/mermaid.min.js"
_DRAW = "async text => (await window.mermaid.render('drawing', text)).svg"
_TEXTS = (
    "svg => [...new DOMParser().parseFromString(svg, 'text/html').querySelectorAll(%r)].map(each => each.textContent)"
)


@pytest.mark.parametrize("text", [NESTED, WORLD, hostile_urdf()], ids=["nested", "world", "hostile"])
def test_an_svg_opens_and_does_nothing(watched: Watched, tmp_path: Path, text: str) -> None:
    graph = graph_of(text, frames=True, mimics=True)
    (tmp_path / "graph.svg").write_text(svg(graph), encoding="utf-8")
    page = watched.open(tmp_path / "graph.svg")
    assert (watched.complaints, watched.outside) == ([], [])
    assert page.locator("g > g > rect").count() == len(graph.nodes)
    texts = page.evaluate("() => [...document.querySelectorAll('g text')].map(each => each.textContent)")
    assert {shortened(node.label) for node in graph.nodes} <= set(texts)


def test_the_words_of_an_svg_fit_into_their_boxes(watched: Watched, tmp_path: Path) -> None:
    (tmp_path / "graph.svg").write_text(svg(graph_of(hostile_urdf())), encoding="utf-8")
    boxes = watched.open(tmp_path / "graph.svg").evaluate(
        "() => [...document.querySelectorAll('g > g')].map(g => [g.querySelector('rect'), g.querySelector('text')]"
        ".map(each => each.getBBox().width))"
    )
    assert boxes
    assert all(text < box for box, text in boxes)


def test_an_svg_is_dark_on_a_dark_screen(watched: Watched, tmp_path: Path) -> None:
    (tmp_path / "graph.svg").write_text(svg(graph_of(NESTED)), encoding="utf-8")
    page = watched.open(tmp_path / "graph.svg")
    colors: list[str] = []
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        colors.append(page.evaluate("() => getComputedStyle(document.querySelector('.page')).fill"))
        colors.append(page.evaluate("() => getComputedStyle(document.documentElement).backgroundColor"))
    assert colors == ["rgb(255, 255, 255)"] * 2 + ["rgb(18, 24, 31)"] * 2, "beside the drawing too"


@pytest.mark.skipif(not _MERMAID.is_file(), reason="Mermaid is not here: npm install --prefix out/readers mermaid")
def test_mermaid_draws_every_name_as_it_is(watched: Watched, tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text('<!DOCTYPE html><meta charset="utf-8"><body>', encoding="utf-8")
    page = watched.open(tmp_path / "page.html")
    page.add_script_tag(path=_MERMAID)
    for text in (NESTED, WORLD, hostile_urdf()):
        graph = graph_of(text, frames=True, mimics=True)
        drawn = page.evaluate(_DRAW, mermaid(graph))
        labels = page.evaluate(_TEXTS % ".node .nodeLabel", drawn)
        assert sorted(each.replace("\N{WORD JOINER}", "") for each in labels) == sorted(_labels(graph))
        titles = page.evaluate(_TEXTS % ".cluster-label .nodeLabel", drawn)
        assert sorted(titles) == sorted(each.name for each in graph.clusters[graph.clusters[0].kind == "model" :])
        assert page.evaluate(_TEXTS % "script, [onload], img", drawn) == []
    assert watched.complaints == []


def _labels(graph: Graph) -> list[str]:
    """What Mermaid makes of labels: it leaves blanks at the ends out."""
    names = [shortened(node.label).strip() for node in graph.nodes]
    return names + ["".join((shortened(each.label).strip(), each.type, *each.details)) for each in graph.joints]
