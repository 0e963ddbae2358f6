import json
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.diagnostics import NOWHERE, Diagnostic, Location, Rule, Severity, catalog
from twinform.diagnostics.reporters import REPORTERS, Findings, text

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
FILES = [Findings("a.urdf", (FULL, BARE)), Findings("clean.sdf")]


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
    assert text([Findings("x", (nasty,))]).splitlines() == [
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
                        "path": "/robot/link[@name='a']",
                        "help": "write 2",
                        "found": "3",
                        "expected": "even",
                        "related": [
                            {"line": 3, "path": "/robot"},
                            {"line": 5, "path": "", "file": "other.sdf"},
                        ],
                    },
                    {
                        "rule": "odd-value",
                        "severity": "warning",
                        "message": "the file is odd",
                        "line": 0,
                        "path": "",
                        "help": None,
                        "found": None,
                        "expected": None,
                        "related": [],
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
    assert REPORTERS["github"]([Findings("x", (odd,))]) == (
        "::notice file=C%3A\\a%2Cb%25.urdf,line=1,title=odd-value::100%25 a,b:c%0D%0Aend\n"
    )


def sarif(files: list[Findings]) -> dict[str, Any]:
    log = json.loads(REPORTERS["sarif"](files))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    return run


def test_sarif_lists_the_catalog_and_the_rules_of_others() -> None:
    rules = sarif(FILES)["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == sorted([*catalog(), "odd-value"])


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
    (result,) = sarif([Findings(file, (BARE,))])["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == uri


@pytest.mark.parametrize("name", ["text", "github"])
def test_no_findings_are_no_text(name: str) -> None:
    assert REPORTERS[name]([Findings("clean.sdf")]) == ""


WORDS = st.text(max_size=10)
PLACES = st.builds(Location, st.sampled_from(["", "other.sdf", "new\nline.sdf"]), st.integers(0, 9), WORDS)
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
}


@given(st.lists(DIAGNOSTICS, max_size=3))
@pytest.mark.parametrize("name", REPORTERS)
def test_every_finding_is_reported_once_whatever_is_in_it(name: str, found: list[Diagnostic]) -> None:
    report = REPORTERS[name]([Findings("robot.urdf", tuple(found))])
    report.encode()
    assert ONE_LINE[name](report) == len(found)
