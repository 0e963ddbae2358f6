"""Which findings have one cause."""

from twinform.diagnostics import Diagnostic, Location, Rule, Severity
from twinform.diagnostics.reporters.file_findings import grouped

RULE = Rule(name="odd", severity=Severity.ERROR, finds="Odd.", matters="So.", example="3", better="2")


def finding(message: str, name: str = "x", found: str | None = None, line: int = 1) -> Diagnostic:
    return Diagnostic(RULE, message, Location("a", line, f"/robot/link[@name='{name}']"), Severity.ERROR, found)


def counts(*findings: Diagnostic) -> list[int]:
    return [1 + len(group.others) for group in grouped(findings)]


def test_the_names_of_places_do_not_count() -> None:
    assert counts(*(finding(f"link '{name}' is odd", name) for name in "abc")) == [3]
    assert counts(*(finding(f"link '{name}' is odd", "z") for name in "abc")) == [1, 1, 1]


def test_what_was_found_counts() -> None:
    assert counts(*(finding(f"'{name}' is twice", name, found=name) for name in "abc")) == [1, 1, 1]
    assert counts(*(finding("'ruber' is nothing", name, found="ruber") for name in "abc")) == [3]


def test_two_are_shown_each_and_in_their_order() -> None:
    found = [finding("a", line=1), finding("b", line=2), finding("a", line=3), *(finding("c") for _ in "123")]
    assert [group.first for group in grouped(found)] == found[:4]
    assert [len(group.others) for group in grouped(found)] == [0, 0, 0, 2]
    assert len(grouped(found, every=True)) == len(found)
