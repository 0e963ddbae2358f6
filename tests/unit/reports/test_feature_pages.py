"""The pages of features: every cell stands in the matrix, every feature has its file, and every row its place."""

import json
import re

import pytest

from reports.who_reads_it.feature_pages import CELLS, pages
from twinform.profiles.features import features

_FEATURES = [
    {"name": "joints/ball", "format": "SDF", "title": "A <ball>", "question": "Is it there?", "file": "<sdf/>\n"},
    {"name": "text/mark", "format": "URDF", "title": "A mark", "question": "Is it read?", "file": "<robot>\n"},
]


def _consumer(name: str, title: str) -> dict[str, object]:
    return {"name": name, "title": title, "release": name.partition("@")[2]}


def _cell(feature: str, consumer: str, verdict: str, **more: object) -> dict[str, object]:
    return {"feature": feature, "consumer": consumer, "verdict": verdict, **more}


@pytest.fixture
def made() -> dict[str, str]:
    """The pages of a small matrix, with three releases of one program and one of another."""
    gazebo = ("gazebo@garden", "gazebo@ionic", "gazebo@jetty")
    cells = [
        *(_cell("joints/ball", name, "differs", rows=["drops: it has `none`"]) for name in gazebo),
        *(_cell("text/mark", name, "reads") for name in gazebo[:2]),
        _cell("text/mark", "gazebo@jetty", "warns"),
        _cell("text/mark", "drake@1.51", "refuses", measured="refuses", message="`a` | <b>"),
    ]
    consumers = [*(_consumer(name, "Gazebo") for name in gazebo), _consumer("drake@1.51", "Drake")]
    return pages(json.dumps({"consumers": consumers, "features": _FEATURES, "cells": cells}))


def test_every_cell_has_its_verdict_in_the_matrix_and_says_whether_it_was_measured(made: dict[str, str]) -> None:
    assert "| [A \\<ball>](joints.md#ball) | SDF | *differs* | *differs* |  |" in made["README.md"]
    assert "| [A mark](text.md#mark) | URDF | *reads* | *warns* | refuses |" in made["README.md"]


def test_releases_that_follow_each_other_share_a_column_where_the_same_is_said(made: dict[str, str]) -> None:
    gazebo = "[Gazebo](../profiles/gazebo.md)"
    head = f"| feature | format | {gazebo} garden to ionic | {gazebo} jetty | [Drake](../profiles/drake.md) 1.51 |"
    assert head in made["README.md"]


def test_a_group_has_the_file_of_each_feature_and_the_gravest_verdict_first(made: dict[str, str]) -> None:
    assert "## ball\n\n**A \\<ball>.** Is it there?\n\n```xml\n<sdf/>\n```" in made["joints.md"]
    assert "```text\n<robot>\n```" in made["text.md"], "it is no XML"
    rows = re.findall(r"^\| (\*?\w+\*?) \| .*$", made["text.md"], re.MULTILINE)
    assert rows == ["verdict", "refuses", "*warns*", "*reads*"]
    assert "| `'a' \\| <b>` |" in made["text.md"]
    assert "| [gazebo](../profiles/gazebo.md) garden, ionic |" in made["text.md"]


def test_the_committed_matrix_is_about_the_features_that_there_are() -> None:
    page = pages(CELLS.read_text(encoding="utf-8"))["README.md"]
    assert len(re.findall(r"^\| \[", page, re.MULTILINE)) == len(features())
