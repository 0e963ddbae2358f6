import json
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.diagnostics import NOWHERE, Diagnostic, Fix, Location, Rule, Safety, Severity, Span, TextEdit
from twinform.diagnostics.reporters import NO_TEXTS, REPORTERS, FileFindings, text
from twinform.diagnostics.rules import DANGLING_LINK

RULE = Rule(name="odd-value", severity=Severity.ERROR, finds="Odd.", matters="So.", example="3", better="2")
FULL = Diagnostic(
    RULE,
    "the value is '3'; expected an even one",
    Location("a.urdf", 12, "/robot/link[@name='a']"),
    Severity.ERROR,
    found="3",
    expected="even",
    help="write 2",
    related=(Location("a.urdf", 3, "/robot"), Location("other.sdf", 5)),
)
BARE = Diagnostic(RULE, "the file is odd", NOWHERE, Severity.WARNING)
FILES = [FileFindings("a.urdf", (FULL, BARE)), FileFindings("clean.sdf")]


def test_text_shows_place_severity_headline_rule_path_and_help() -> None:
    assert text(FILES).splitlines() == [
        "a.urdf:12: error: the value is '3'; expected an even one [odd-value]",
        "    at /robot/link[@name='a']",
        "    see a.urdf:3: /robot",
        "    see other.sdf:5",
        "    help: write 2",
        "a.urdf: warning: the file is odd [odd-value]",
    ]


def test_text_paints_only_the_severity() -> None:
    painted = text(FILES, lambda word, severity: f"<{word}{severity.value}>")
    assert painted.replace("<error3>", "error").replace("<warning2>", "warning") == text(FILES)


def test_text_shows_what_a_terminal_would_obey() -> None:
    nasty = Diagnostic(
        RULE, "link '\x1b[2J\x9b\n'", Location("\udcff.urdf", 1, "/\u202e"), Severity.ERROR, help="a\nb\x07"
    )
    assert text([FileFindings("x", (nasty,))]).splitlines() == [
        r"\udcff.urdf:1: error: link '\x1b[2J\x9b\n' [odd-value]",
        r"    at /\u202e",
        "    help: a",
        r"          b\x07",
    ]


def test_json_has_every_key_and_names_other_files() -> None:
    assert json.loads(REPORTERS["json"](FILES)) == {
        "files": [
            {
                "path": "a.urdf",
                "diagnostics": [
                    {
                        "rule": "odd-value",
                        "severity": "error",
                        "message": "the value is '3'; expected an even one",
                        "line": 12,
                        "column": 0,
                        "end_line": 0,
                        "end_column": 0,
                        "path": "/robot/link[@name='a']",
                        "help": "write 2",
                        "found": "3",
                        "expected": "even",
                        "related": [
                            {"line": 3, "column": 0, "end_line": 0, "end_column": 0, "path": "/robot"},
                            {
                                "line": 5,
                                "column": 0,
                                "end_line": 0,
                                "end_column": 0,
                                "path": "",
                                "file": "other.sdf",
                            },
                        ],
                        "fix": None,
                    },
                    {
                        "rule": "odd-value",
                        "severity": "warning",
                        "message": "the file is odd",
                        "line": 0,
                        "column": 0,
                        "end_line": 0,
                        "end_column": 0,
                        "path": "",
                        "help": None,
                        "found": None,
                        "expected": None,
                        "related": [],
                        "fix": None,
                    },
                ],
            },
            {"path": "clean.sdf", "diagnostics": []},
        ]
    }


def test_github_prints_one_command_for_each_finding() -> None:
    assert REPORTERS["github"](FILES).splitlines() == [
        f"::error file=a.urdf,line=12,title=odd-value::{FULL.message}%0Aat {FULL.location.path}%0Ahelp: write 2",
        "::warning file=a.urdf,title=odd-value::the file is odd",
    ]


def test_github_escapes_properties_and_data() -> None:
    odd = Diagnostic(RULE, "100% a,b:c\r\nend", Location("C:\\a,b%.urdf", 1), Severity.INFO)
    assert REPORTERS["github"]([FileFindings("x", (odd,))]) == (
        "::notice file=C%3A\\a%2Cb%25.urdf,line=1,title=odd-value::100%25 a,b:c%0D%0Aend\n"
    )


def sarif(files: list[FileFindings]) -> dict[str, Any]:
    log = json.loads(REPORTERS["sarif"](files))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    return run


def test_sarif_lists_the_rules_that_were_found_with_their_pages() -> None:
    known = Diagnostic(DANGLING_LINK, "no link", NOWHERE, Severity.ERROR)
    own, other = sarif([FileFindings("a.urdf", (FULL, known, BARE))])["tool"]["driver"]["rules"]
    assert (own["id"], other["id"]) == ("dangling-link", "odd-value")
    assert own["help"]["text"].endswith("\nMore: twinform explain dangling-link")
    assert "helpUri" not in own
    assert other["help"]["text"].startswith("What it finds: Odd.\n")
    assert other["help"]["markdown"].startswith("**What it finds.** Odd.\n\n")
    assert sarif([FileFindings("clean.sdf")])["tool"]["driver"]["rules"] == []


def test_sarif_links_to_the_project_once_it_has_an_address(monkeypatch: pytest.MonkeyPatch) -> None:
    found = [FileFindings("a.urdf", (FULL, Diagnostic(DANGLING_LINK, "no link", NOWHERE, Severity.ERROR)))]
    assert "informationUri" not in sarif(found)["tool"]["driver"]
    for module in ("catalog", "reporters.sarif"):
        monkeypatch.setattr(import_module(f"twinform.diagnostics.{module}"), "HOME", "https://example.org/t")
    driver = sarif(found)["tool"]["driver"]
    own, other = driver["rules"]
    assert driver["informationUri"] == "https://example.org/t"
    assert own["helpUri"] == "https://example.org/t/blob/main/twinform/diagnostics/rules/dangling-link.md"
    assert "helpUri" not in other
    assert other["help"]["text"].endswith("\nMore: twinform explain odd-value")


def test_sarif_fingerprints_stay_where_lines_move() -> None:
    def fingerprints(*found: Diagnostic) -> list[str]:
        return [one["partialFingerprints"]["finding/v1"] for one in sarif([FileFindings("a.urdf", found)])["results"]]

    moved = replace(FULL, location=FULL.location._replace(line=99))
    assert fingerprints(FULL) == fingerprints(moved)
    assert len(set(fingerprints(FULL, moved, BARE))) == 3


def test_sarif_results_refer_to_rules_and_places() -> None:
    run = sarif(FILES)
    first, second = run["results"]
    for result in (first, second):
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"] == "odd-value"
    assert first["level"] == "error"
    assert first["message"]["text"] == "the value is '3'; expected an even one\nwrite 2"
    assert first["locations"] == [
        {
            "physicalLocation": {"artifactLocation": {"uri": "a.urdf"}, "region": {"startLine": 12}},
            "logicalLocations": [{"fullyQualifiedName": "/robot/link[@name='a']"}],
        }
    ]
    assert [each["id"] for each in first["relatedLocations"]] == [0, 1]
    assert second["locations"] == [{"physicalLocation": {"artifactLocation": {"uri": "a.urdf"}}}]


@pytest.mark.parametrize(
    ("file", "uri"),
    [
        ("models/a b.urdf", "models/a%20b.urdf"),
        ("/tmp/a#1.sdf", "file:///tmp/a%231.sdf"),
        ("<stdin>", "%3Cstdin%3E"),
        ("100%:x.sdf", "100%25%3Ax.sdf"),
        ("\udcff.sdf", "%FF.sdf"),
    ],
)
def test_sarif_writes_files_as_uris(file: str, uri: str) -> None:
    (result,) = sarif([FileFindings(file, (BARE,))])["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == uri


@pytest.mark.parametrize("name", ["text", "github"])
def test_no_findings_are_no_text(name: str) -> None:
    assert REPORTERS[name]([FileFindings("clean.sdf")]) == ""


WORDS = st.text(max_size=10)
PLACES = st.builds(
    Location,
    st.sampled_from(["", "other.sdf", "new\nline.sdf"]),
    st.integers(0, 9),
    WORDS,
    st.integers(0, 9),
    st.integers(0, 9),
    st.integers(0, 9),
)
DIAGNOSTICS = st.builds(
    Diagnostic,
    st.just(RULE),
    WORDS,
    PLACES,
    st.sampled_from(Severity),
    help=st.none() | WORDS,
    related=st.lists(PLACES, max_size=2).map(tuple),
)
ONE_LINE: dict[str, Callable[[str], int]] = {
    "json": lambda report: sum(len(file["diagnostics"]) for file in json.loads(report)["files"]),
    "sarif": lambda report: len(json.loads(report)["runs"][0]["results"]),
    "github": lambda report: report.count("\n"),
    "text": lambda report: sum(line[:1] != " " for line in report.split("\n")[:-1]),
    "concise": lambda report: report.count("\n"),
    "junit": lambda report: sum(len(test) for test in ET.fromstring(report).iter("testcase")),
}


class OneLine:
    """A text of which one line is known."""

    def __init__(self, text: str) -> None:
        self.text = text

    def line(self, file: str, number: int) -> str | None:
        del file
        return self.text if number else None

    def place(self, file: str, offset: int) -> tuple[int, int] | None:
        return NO_TEXTS.place(file, offset) if offset > len(self.text) else (1, offset + 1)


@given(st.lists(DIAGNOSTICS, max_size=2), st.text(max_size=30).filter(lambda line: "\n" not in line))
@pytest.mark.parametrize("name", REPORTERS)
def test_every_finding_is_reported_once_whatever_is_in_it(name: str, found: list[Diagnostic], line: str) -> None:
    report = REPORTERS[name]([FileFindings("robot.urdf", tuple(found), OneLine(line))])
    report.encode()
    assert ONE_LINE[name](report) == len(found)


PLACED = replace(FULL, location=Location("a.urdf", 1, "/robot", 3, 1, 5))
FIXED = replace(PLACED, fix=Fix("write 2", (TextEdit(Span(2, 4), "2"), TextEdit(Span(9, 9), "x")), Safety.UNSAFE))
TEXT = OneLine("a 33 bcd e")


def test_text_shows_the_piece_and_the_fix() -> None:
    assert text([FileFindings("a.urdf", (FIXED,), TEXT)], lambda word, _: f"<{word}>").splitlines() == [
        "a.urdf:1:3: <error>: the value is '3'; expected an even one [odd-value]",
        "    at /robot",
        "    1 | a 33 bcd e",
        "      |   <^^>",
        "    see a.urdf:3: /robot",
        "    see other.sdf:5",
        "    help: write 2",
        "    fix (unsafe): write 2",
    ]


def test_json_has_the_edits_of_a_fix_by_line_and_column() -> None:
    (file,) = json.loads(REPORTERS["json"]([FileFindings("a.urdf", (FIXED,), TEXT)]))["files"]
    (found,) = file["diagnostics"]
    assert (found["line"], found["column"], found["end_line"], found["end_column"]) == (1, 3, 1, 5)
    assert found["fix"] == {
        "title": "write 2",
        "safety": "unsafe",
        "edits": [
            {"line": 1, "column": 3, "end_line": 1, "end_column": 5, "new": "2"},
            {"line": 1, "column": 10, "end_line": 1, "end_column": 10, "new": "x"},
        ],
    }


def test_a_fix_of_a_text_that_is_not_at_hand_is_not_told() -> None:
    (file,) = json.loads(REPORTERS["json"]([FileFindings("a.urdf", (FIXED,))]))["files"]
    assert file["diagnostics"][0]["fix"] is None
    assert "fixes" not in sarif([FileFindings("a.urdf", (FIXED,))])["results"][0]


def test_sarif_has_columns_and_fixes() -> None:
    (result,) = sarif([FileFindings("a.urdf", (FIXED,), TEXT)])["results"]
    region = {"startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 5}
    assert result["locations"][0]["physicalLocation"]["region"] == region
    (fix,) = result["fixes"]
    assert (fix["description"], fix["properties"]) == ({"text": "write 2 (unsafe)"}, {"safety": "unsafe"})
    (change,) = fix["artifactChanges"]
    assert change["artifactLocation"] == {"uri": "a.urdf"}
    assert change["replacements"][0] == {"deletedRegion": region, "insertedContent": {"text": "2"}}
    assert change["replacements"][1]["deletedRegion"]["startColumn"] == 10


@pytest.mark.parametrize(
    ("where", "properties"),
    [
        (Location("a", 1, "", 3, 1, 5), "file=a,line=1,col=3,endLine=1,endColumn=5,"),
        (Location("a", 1, "", 3), "file=a,line=1,col=3,"),
        (Location("a", 1, "", 3, 2, 5), "file=a,line=1,endLine=2,"),
    ],
)
def test_github_has_columns_of_one_line(where: Location, properties: str) -> None:
    report = REPORTERS["github"]([FileFindings("a", (replace(BARE, location=where),))])
    assert report.startswith(f"::warning {properties}title=odd-value::")


def test_concise_has_one_line_for_each() -> None:
    assert REPORTERS["concise"]([FileFindings("a.urdf", (PLACED, BARE))]).splitlines() == [
        "a.urdf:1:3: error: the value is '3'; expected an even one [odd-value]",
        "a.urdf: warning: the file is odd [odd-value]",
    ]


def test_junit_has_a_suite_for_each_file_and_fails_for_errors_only() -> None:
    root = ET.fromstring(REPORTERS["junit"]([FileFindings("a.urdf", (PLACED, BARE)), FileFindings("clean.sdf")]))
    assert {key: root.get(key) for key in ("tests", "failures", "errors", "skipped")} == {
        "tests": "3",
        "failures": "1",
        "errors": "0",
        "skipped": "1",
    }
    first, clean = root
    error, warning = first
    assert (error.get("name"), error.get("classname"), error.get("line")) == ("odd-value 1:3 /robot", "a.urdf", "1")
    assert error[0].tag == "failure"
    assert error[0].get("message") == PLACED.message
    assert (error[0].text or "").startswith("a.urdf:1:3: error: the value")
    assert warning[0].tag == "skipped"
    assert [(test.get("name"), len(test)) for test in clean] == [("no findings", 0)]


def test_junit_is_xml_whatever_is_in_it() -> None:
    nasty = Diagnostic(RULE, 'a<b>&"\x00\x1b\ud800', Location("x\x07.urdf", 1, "/\uffff"), Severity.ERROR)
    (suite,) = ET.fromstring(REPORTERS["junit"]([FileFindings("x\x07.urdf", (nasty,))]))
    assert suite[0][0].get("message") == r'a<b>&"\x00\x1b\ud800'
