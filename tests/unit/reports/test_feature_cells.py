"""Cells of features: what was seen counts, what a profile says is added, and a run names what changed."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from reports.who_reads_it import feature_cells
from reports.who_reads_it.feature_cells import Cell, Column, as_json, assessments, cell_of, changes, columns, read_cells
from reports.who_reads_it.feature_pages import CELLS
from testbed.engines.readers import LOADERS, Kept, Loader, Reading
from twinform.profiles import load
from twinform.profiles.features import PLAIN, features

_A = Cell("joints/mimic", "drake@1.51", "reads", "reads")
_B = Cell("joints/mimic", "gazebo@jetty", "reads")


def test_a_second_run_over_the_same_finds_no_difference() -> None:
    assert [*changes([_A, _B], [_B, _A])] == []


def test_a_run_names_cells_with_another_verdict_and_those_that_are_new_or_gone() -> None:
    warned, asked = replace(_A, verdict="warns", measured="warns"), replace(_B, measured="reads")
    assert [*changes([_A, _B], [warned, asked])] == [
        "joints/mimic: drake@1.51: reads -> warns",
        "joints/mimic: gazebo@jetty: seen: not asked -> reads",
    ]
    assert [*changes([_A], [_B])] == [
        "joints/mimic: drake@1.51: reads -> not there",
        "joints/mimic: gazebo@jetty: not there -> reads",
    ]


def test_cells_are_read_as_they_were_written(tmp_path: Path) -> None:
    path = tmp_path / "cells.json"
    assert read_cells(path) == []
    full = replace(_A, message='says "no"', kept="links a", rows=("drops: one", "warns: two"), disagrees="it refuses")
    path.write_text(as_json([full, _B], features()), encoding="utf-8")
    assert read_cells(path) == [full, _B]
    assert len(json.loads(path.read_text(encoding="utf-8"))["features"]) == len(features())


@pytest.fixture
def answered(monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str, Reading], Cell]:
    """The cell of a feature where the loader of a profile answers what is given."""

    def cell(feature: str, profile: str, reading: Reading) -> Cell:
        def answer(loader: Loader, path: Path) -> Reading:
            return reading

        monkeypatch.setattr(feature_cells, "_ask", answer)
        loader = next(each for each in LOADERS if each.profile == profile)
        told = zip(columns(), assessments(features()[feature]), strict=True)
        said = next(each for column, each in told if column.profile.name == profile)
        return cell_of(features()[feature], Column(load(profile)[0], loader), said)

    return cell


_WHOLE = Kept(("a", "b"), ("j",), {"a": 1.0, "b": 1.0}, 0)


@pytest.mark.parametrize(
    ("reading", "verdict", "disagrees"),
    [
        (Reading("", "", _WHOLE), "reads", ""),
        (Reading("", "Warning: hm", _WHOLE), "warns", "it warns, the profile has nothing"),
        (Reading("", "", replace(_WHOLE, joints=())), "differs", "it keeps less, the profile has nothing"),
        (Reading("", "", replace(_WHOLE, masses={"a": 1.0})), "differs", "it keeps less, the profile has nothing"),
        (Reading("Error: no", ""), "refuses", "it refuses, the profile does not"),
    ],
)
def test_a_cell_has_the_verdict_that_was_seen(
    answered: Callable[[str, str, Reading], Cell], reading: Reading, verdict: str, disagrees: str
) -> None:
    cell = answered(PLAIN, "urdfdom", reading)
    assert (cell.verdict, cell.measured, cell.disagrees) == (verdict, verdict, disagrees)


def test_what_a_profile_says_is_read_otherwise_counts_beside_what_was_seen(
    answered: Callable[[str, str, Reading], Cell],
) -> None:
    cell = answered("shapes/size-zero", "dart", Reading("", "", replace(_WHOLE, shapes=2)))
    assert (cell.verdict, cell.measured) == ("differs", "reads")
    assert cell.rows == ("misreads: it makes a box of 1 m",)


def test_a_consumer_of_which_little_is_known_has_a_cell_only_where_a_row_is_about_it() -> None:
    committed = {(each.feature, each.consumer) for each in read_cells(CELLS)}
    assert ("joints/sdf-continuous", "gazebo-classic@11") in committed
    assert ("joints/sdf-ball", "gazebo-classic@11") not in committed


def test_the_committed_cells_have_the_rows_that_profiles_have_now() -> None:
    """Where a profile changes, its cells are measured again: `make report NAME=who_reads_what`."""
    committed = {(each.feature, each.consumer): each.rows for each in read_cells(CELLS)}
    for feature in [*features().values()][::7]:
        told = zip(columns(), assessments(feature), strict=True)
        now = {
            (feature.name, column.name): tuple(dict.fromkeys(f"{e.row.effect}: {e.row.about}" for e in each.judgments))
            for column, each in told
            if each.reads and (each.judgments or each.profile.is_complete)
        }
        assert {key: rows for key, rows in committed.items() if key[0] == feature.name} == now
