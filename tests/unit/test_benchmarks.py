"""The measuring commands measure what they say."""

import os
import time
import tomllib
from pathlib import Path

import pytest

import twinform
from benchmarks import robots
from benchmarks.astray import by_place
from benchmarks.known import Known
from benchmarks.markdown import table
from benchmarks.mutants import is_assertion, is_wording
from tests.oracles import urdfdom
from twinform.testing.round_trips import Astray
from twinform.testing.workers import Failure, run


@pytest.mark.parametrize("links", [1, 2, 40])
def test_generated_robots_are_without_a_fault(links: int, tmp_path: Path):
    path = tmp_path / "robot.urdf"
    path.write_text(robots.urdf(links))
    checked = twinform.check(path)
    assert checked.diagnostics == ()
    assert checked.document is not None
    assert len(checked.document.models[0].links) == links
    assert not urdfdom.available() or urdfdom.complaints(path) == ()


def test_generated_robots_have_the_elements_that_the_page_speaks_of():
    elements = [robots.urdf(links).count("<") - robots.urdf(links).count("</") for links in (100, 101)]
    assert elements[1] - elements[0] == robots.ELEMENTS_PER_LINK


def test_a_job_that_dies_or_hangs_harms_no_other():
    found = dict(run(_task, range(8), seconds=3, processes=2))
    assert {n for n, result in found.items() if result == n * n} == {0, 1, 3, 4, 6, 7}
    assert isinstance(found[2], Failure)
    assert "exit code 7" in found[2].cause
    assert isinstance(found[5], Failure)
    assert "end" in found[5].cause


def test_a_fault_in_the_task_is_raised():
    with pytest.raises(RuntimeError, match="ZeroDivisionError"):
        list(run(_divide, [0]))


def test_numbers_stand_to_the_right_and_bars_are_escaped():
    assert table(["a", "b"], [("x|y", 1), ("z", "2.5")]).splitlines() == [
        "| a | b |",
        "| --- | ---: |",
        "| x\\|y | 1 |",
        "| z | 2.5 |",
    ]


def test_a_file_is_explained_by_itself_or_by_all_of_its_rules():
    known = Known({"a": "why"}, {"b": "so"}, {"one": "first", "two": "second"})
    assert known.why_refused("a") == "why"
    assert known.why_refused("b") == ""
    assert known.why_not_converted("b", ("three",)) == "so"
    assert known.why_not_converted("c", ("one", "two")) == "first; second"
    assert known.why_not_converted("c", ("one", "three")) == ""


@pytest.mark.parametrize("file", ["corpus_known.toml", "versions_known.toml"])
def test_the_tables_of_reasons_hold_files_that_there_are(corpus: Path, file: str):
    tables = tomllib.loads((Path(robots.__file__).parent / file).read_text())
    names = [name for title, table in tables.items() if not title.endswith("_rules") for name in table]
    assert [name for name in names if not (corpus / name).is_file()] == []


def _task(number: int) -> int:
    if number == 2:
        os._exit(7)
    if number == 5:
        time.sleep(60)
    return number * number


def _divide(number: int) -> float:
    return 1 / number


@pytest.mark.parametrize(
    ("before", "after", "wording"),
    [
        ('say("no link", where)', 'say("XXno linkXX", where)', True),
        ('say("no link", where)', 'say("NO LINK", where)', True),
        ('say("no link", "a")', 'say("no link", "XXaXX")', False),
        ('tag = "link"', 'tag = "LINK"', False),
        ('say("no link", where)', "say(None, where)", False),
        ('say("no link", where)', 'say("no link", None)', False),
        ('say("no link", "no joint")', 'say("no joint")', False),
    ],
)
def test_mutants_that_only_change_the_wording_are_known(before: str, after: str, wording: bool):
    assert is_wording((f"-    {before}", f"+    {after}")) is wording


@pytest.mark.parametrize("after", ["zip(a, b, strict=None)", "zip(a, b, )", "zip(a, b, strict=False)"])
def test_mutants_that_only_take_an_assertion_away_are_known(after: str):
    assert is_assertion(("-for x in zip(a, b, strict=True):", f"+for x in {after}:"))


@pytest.mark.parametrize("after", ["zip(a, None, strict=True)", "zip(a, strict=True)", "zip(b, strict=True)"])
def test_mutants_that_change_what_is_zipped_take_more(after: str):
    assert not is_assertion(("-for x in zip(a, b, strict=True):", f"+for x in {after}:"))


@pytest.mark.parametrize("after", ["None", '"NODE"', '"node"', '"XXNodeXX"'])
def test_the_type_of_a_cast_is_an_assertion(after: str) -> None:
    assert is_assertion(('-x = f(cast("Node", old or ()), 1)', f"+x = f(cast({after}, old or ()), 1)"))
    assert not is_assertion(('-x = f(cast("Node", old or ()), 1)', f"+x = f(cast({after}, old and ()), 1)"))


def test_what_is_astray_is_counted_by_kind_and_place_whatever_it_is_called():
    lost = [Astray("missing", f"/robot/link[@name='{name}']/@type", f"{name} is not back") for name in "abc"]
    assert by_place([("y", lost[1:]), ("x", [*lost[:1], Astray("order", "/robot/joint[2]", "order")])]) == [
        (2, 3, "missing", "/robot/link/@type", "x: a is not back"),
        (1, 1, "order", "/robot/joint", "x: order"),
    ]
