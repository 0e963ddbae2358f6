"""The harness: samples, known causes, tables, pages of sections, exit codes, and the list of all sections."""

import argparse
from dataclasses import dataclass
from pathlib import Path

import pytest

from reports import __main__ as command
from reports.harness import question as harness
from reports.harness.known import Known
from reports.harness.question import Question, question_of, questions, sections_by_title
from reports.harness.sample import Sample, in_turn
from reports.harness.section import Findings, Section
from testbed.corpus.files import ROOT
from testbed.markdown import cross_table, listing, table

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
SECTIONS = [(question, name) for question in questions().values() for name in question.sections]


@dataclass(frozen=True)
class _Model:
    name: str


@dataclass(frozen=True)
class _Asked(Question):
    """A question whose sections are made up."""

    made: tuple[Section, ...] = ()

    def section(self, name: str) -> Section:
        return next(each for each in self.made if each.name == name)

    def asked(self, name: str) -> str:
        return f"What is {name}?"


@pytest.fixture
def known(tmp_path: Path) -> Known:
    (tmp_path / "lengths.toml").write_text(KNOWN)
    return Known.beside(str(tmp_path / "lengths.py"))


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The page of the question `size`, which is not there."""
    monkeypatch.setattr(harness, "ROOT", tmp_path)
    return tmp_path / "docs" / "evidence" / "size.md"


def _section(name: str, text: str, *faults: str, missing: str = "", known: Known | None = None) -> Section:
    return Section(name, "About.", lambda _: Findings([text], "summary", faults), (lambda: missing,), known)


def _question(*sections: Section) -> Question:
    return _Asked("size", "How large?", {each.name: each.name.title() for each in sections}, sections)


def _run(question: Question, name: str, *options: str) -> int:
    given: argparse.Namespace = command.options(name, options)
    return command.run(question, name, given)


def test_numbers_stand_to_the_right_and_bars_are_escaped():
    assert table(["a", "b"], [("x|y", 1), ("z", "2.5")]).splitlines() == [
        "| a | b |",
        "| --- | ---: |",
        "| x\\|y | 1 |",
        "| z | 2.5 |",
    ]


def test_a_cross_table_has_a_row_for_each_name_and_zeros_where_nothing_was_met():
    met = [("a", "good"), ("b", "bad"), ("a", "good")]
    assert cross_table(["name"], met, ["good", "bad"]).splitlines()[2:] == ["| a | 2 | 0 |", "| b | 0 | 1 |"]


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


def test_a_section_is_written_into_its_page_and_the_others_stay(page: Path):
    length, width = _section("length", "### Totals\n\n7 m"), _section("width", "3 m")
    question = _question(length, width)
    assert _run(question, "width") == 0
    assert _run(question, "length") == 0
    before = page.read_text()
    assert before == (
        "# How large?\n\n* [Length](#length): What is length?\n* [Width](#width): What is width?\n\n"
        "## Length\n\nMade by `make report NAME=length`.\n\nAbout.\n\n### Totals\n\n7 m\n\n"
        "## Width\n\nMade by `make report NAME=width`.\n\nAbout.\n\n3 m\n"
    )
    assert _run(_question(length, _section("width", "4 m")), "width") == 0
    assert page.read_text() == before.replace("3 m", "4 m")
    assert sections_by_title(before)["Length"].endswith("7 m")


def test_a_part_is_printed_and_says_so(capsys: pytest.CaptureFixture[str], page: Path):
    question = _question(_section("length", "7 m"))
    assert _run(question, "length", "--every", "2") == 0
    assert 'NAME=length ARGS="--every 2"`, from one of 2 models.\n' in capsys.readouterr().out
    assert not page.exists()
    assert _run(question, "length", "--every", "2", "--write") == 0
    assert "from one of 2 models." in page.read_text()


def test_what_has_no_reason_fails_and_what_cannot_be_measured_is_another_failure(
    capsys: pytest.CaptureFixture[str], page: Path
):
    assert _run(_question(_section("length", "", "odd")), "length", "--every", "2") == 1
    assert "odd" in capsys.readouterr().err
    assert _run(_question(_section("length", "", missing="no engine")), "length") == 2
    assert "no engine" in capsys.readouterr().err
    assert not page.exists()


def test_causes_that_are_not_met_fail_where_all_was_measured(known: Known, page: Path):
    question = _question(_section("length", "", known=known))
    assert _run(question, "length") == 1
    assert page.exists()
    assert _run(question, "length", "--every", "2") == 0


@pytest.mark.parametrize(("question", "name"), SECTIONS, ids=lambda each: each if isinstance(each, str) else "")
def test_a_section_has_its_name_a_question_and_a_place_in_its_page(question: Question, name: str):
    if name == "mutation":
        pytest.importorskip("mutmut", reason="mutmut is not installed")
    assert question.section(name).name == name
    assert question_of(name) == question
    assert question.asked(name).endswith((".", "?"))
    page = question.page.read_text(encoding="utf-8")
    assert question.sections[name] in sections_by_title(page)
    assert page == question.text({})


def test_every_page_is_in_the_index_and_answers_a_question():
    index = (ROOT / "docs/evidence/README.md").read_text()
    assert [each.name for each in questions().values() if f"| [{each.name}]({each.name}.md) |" not in index] == []
    pages = {path.stem for path in (ROOT / "docs/evidence").glob("*.md")} - {"README"}
    assert pages == {*questions()}
    assert not {*questions()} & {name for _, name in SECTIONS}


def test_sections_are_listed_and_a_name_that_is_none_is_wrong_usage(capsys: pytest.CaptureFixture[str]):
    assert command.main([]) == 0
    assert capsys.readouterr().out.count("\n") == len(questions()) + len(SECTIONS)
    assert command.main(["nothing"]) == 2
    assert command.main(["safety", "--section", "length"]) == 2
