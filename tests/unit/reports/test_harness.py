"""The harness: samples, known causes, tables, pages, exit codes, and the list of all reports."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from reports.__main__ import main, names, question, report
from reports.harness.known import Known
from reports.harness.pages import listing, table
from reports.harness.report import Findings, Report, run
from reports.harness.sample import Sample, in_turn
from tests.corpus.files import ROOT

KNOWN = """
[files]
"a/*" = "all of a"
"b[1].sdf" = "a name with brackets"
[[rows]]
file = "a/*"
message = "*mass*"
reason = "of a mass"
[[rows]]
message = "*"
reason = "of the rest"
"""


@dataclass(frozen=True)
class _Model:
    name: str


@pytest.fixture
def known(tmp_path: Path) -> Known:
    (tmp_path / "known.toml").write_text(KNOWN)
    return Known.beside(str(tmp_path / "report.py"))


def test_numbers_stand_to_the_right_and_bars_are_escaped():
    assert table(["a", "b"], [("x|y", 1), ("z", "2.5")]).splitlines() == [
        "| a | b |",
        "| --- | ---: |",
        "| x\\|y | 1 |",
        "| z | 2.5 |",
    ]


def test_a_long_list_is_cut_and_an_empty_one_is_none():
    assert listing(["a"], []) == "None."
    assert listing(["a"], [("x",), ("y",), ("z",)], most=1).splitlines()[-2:] == ["", "2 more."]


def test_the_first_cause_that_fits_is_found_and_what_is_not_used_is_reported(known: Known):
    assert known.why("files", "a/b") == "all of a"
    assert known.why("files", "b[1].sdf") == "a name with brackets"
    assert known.why("rows", file="c", message="no mass") == "of the rest"
    assert known.why("files", "c") == ""
    assert len(known.unused()) == 1
    assert known.why("rows", file="a/b", message="no mass") == "of a mass"
    assert known.unused() == []


def test_a_sample_is_one_of_so_many_of_what_is_named():
    models = [_Model(name) for name in ("a/1", "a/2", "b/1", "b/2", "b/3")]
    assert [each.name for each in Sample(every=2).of(models)] == ["a/1", "b/1", "b/3"]
    assert [each.name for each in Sample(files=("2", "b/3")).of(models)] == ["a/2", "b/2", "b/3"]
    assert [each.name for each in in_turn(models)] == ["a/1", "b/1", "a/2", "b/2", "b/3"]


def _report(faults: tuple[str, ...] = (), missing: str = "") -> Report:
    return Report("none", "Nothing", "About.", lambda _: Findings(["Text."], "summary", faults), (lambda: missing,))


def test_a_sample_is_printed_and_written_where_the_option_says(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    text = "# Nothing\n\nMade by `make report NAME=none`.\n\nAbout.\n\nText.\n"
    part = text.replace("none`.", 'none ARGS="--every 2"`, from one of 2 models.')
    assert run(_report(), ["--every", "2"]) == 0
    assert capsys.readouterr().out == f"{part}\n"
    assert run(_report(), ["--output", str(tmp_path / "new" / "page.md")]) == 0
    assert (tmp_path / "new" / "page.md").read_text() == text
    assert not _report().page.exists()


def test_what_has_no_reason_fails_and_what_cannot_be_measured_is_another_failure(capsys: pytest.CaptureFixture[str]):
    assert run(_report(("odd",)), ["--every", "2"]) == 1
    assert "odd" in capsys.readouterr().err
    assert run(_report(missing="no engine"), []) == 2
    assert "no engine" in capsys.readouterr().err
    assert run(_report(), ["--check"]) == 1


def test_causes_that_are_not_met_fail_where_all_was_measured(known: Known, tmp_path: Path):
    report = Report("none", "Nothing", "About.", lambda _: Findings([], ""), (), known)
    assert run(report, ["--output", str(tmp_path / "page.md")]) == 1
    assert run(report, ["--every", "2"]) == 0


@pytest.mark.parametrize("name", names())
def test_a_report_has_the_name_of_its_page_and_a_question_in_the_index(name: str):
    assert report(name).name == name
    assert report(name).page.is_file()
    assert question(name).endswith((".", "?"))
    index = (ROOT / "docs/evidence/README.md").read_text()
    assert report(name).folder != "evidence" or f"| {question(name)} | [{name}]({name}.md) |" in index


def test_reports_are_listed_and_a_name_that_is_none_is_wrong_usage(capsys: pytest.CaptureFixture[str]):
    assert main([]) == 0
    assert capsys.readouterr().out.count("\n") == len(names())
    assert main(["nothing"]) == 2
