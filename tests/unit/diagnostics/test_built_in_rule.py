"""Built-in rules and their pages, which are read late."""

import pickle
from pathlib import Path

import pytest

from generators.rule_table import rule_line, rule_table
from twinform.diagnostics import Rule, Severity, built_in_rule, catalog, rules
from twinform.diagnostics.built_in_rule import read_head, read_page, rule_names
from twinform.diagnostics.built_in_rule import rule as built_in
from twinform.diagnostics.rule_registry import OWN, find_rule


def test_every_rule_is_found_by_its_name_and_by_its_constant() -> None:
    for name, rule in catalog().items():
        found = find_rule(name)
        assert found
        assert (found.rule, found.owner) == (rule, OWN)
        assert vars(rules)[name.upper().replace("-", "_")] is rule


def test_a_built_in_rule_is_found_without_a_look_at_other_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.entry_points", None)
    assert find_rule("shared-name")


def test_a_page_is_read_once_and_only_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    rule, other = built_in("zero-axis", Severity.ERROR), built_in("zero-axis", Severity.ERROR)
    assert rule.finds == rules.ZERO_AXIS.finds
    monkeypatch.setattr("twinform.diagnostics.built_in_rule.read_page", None)
    assert rule.better == rules.ZERO_AXIS.better
    assert (other, hash(other), repr(other)) == (rule, hash(rule), repr(rule))
    with pytest.raises(TypeError):
        _ = other.better


def test_a_rule_has_no_other_fields() -> None:
    with pytest.raises(AttributeError, match="a rule has no find"):
        getattr(rules.ZERO_AXIS, "find")  # noqa: B009 - a constant name would be a type error


def test_a_rule_is_the_same_one_in_another_process() -> None:
    assert pickle.loads(pickle.dumps(rules.ZERO_AXIS)) is rules.ZERO_AXIS


def test_a_rule_of_a_plugin_is_told_apart_by_its_head() -> None:
    mine = Rule(name="mine", severity=Severity.INFO, finds="a", matters="b", example="c", better="d")
    assert pickle.loads(pickle.dumps(mine)) == mine
    assert mine != Rule(name="mine", severity=Severity.ERROR, finds="a", matters="b", example="c", better="d")


_PAGE = """
## What it finds

A thing that is
not as it should be.

## Why it matters

So.

And more
so.

## Example

`3`

## Better

`2`
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(built_in_rule, "_folder", lambda: tmp_path)
    return tmp_path


def test_every_rule_that_has_a_page_is_in_the_catalog() -> None:
    assert rule_names() == list(catalog())


def test_a_head_and_a_page_are_read(folder: Path) -> None:
    (folder / "odd-thing.md").write_text(f"---\nseverity: warning\nfix: unsafe\nstrict: error\n---\n{_PAGE}")
    assert rule_names() == ["odd-thing"]
    head = read_head("odd-thing")
    line = 'ODD_THING = rule("odd-thing", Severity.WARNING, strict=Severity.ERROR, fix=Safety.UNSAFE)\n'
    assert rule_line("odd-thing", head) == line
    assert read_page("odd-thing") == {
        "finds": "A thing that is not as it should be.",
        "matters": "So.\n\nAnd more so.",
        "example": "`3`",
        "better": "`2`",
        "references": "",
    }


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (_PAGE, "is not a head between two lines of ---"),
        (f"---\nseverity: info\n---\n{_PAGE}\n### More\n\nMore.\n", "paragraphs below each heading"),
        (f"---\nseverity: info\n---\n{_PAGE}\n## References\n", "paragraphs below each heading"),
        (
            f"---\nseverity: info\n---\n{_PAGE}\n## Reference\n\nA book.\n",
            "has the headings .*, Reference; expected are",
        ),
        (f"---\nseverity: info\n---\n{_PAGE.replace('## Better', '## Worse')}", "has the headings .*, Worse"),
        (f"---\nfatal: true\n---\n{_PAGE}", "odd-thing.md has no severity"),
        (f"---\nseverity: grave\n---\n{_PAGE}", "odd-thing.md has `severity: grave`"),
        (f"---\nseverity: info\nsince: 1\n---\n{_PAGE}", "odd-thing.md has `since: 1`"),
        (f"---\nseverity: info\nfatal: false\n---\n{_PAGE}", "odd-thing.md has `fatal: false`"),
    ],
)
def test_a_file_of_another_form_is_an_error(folder: Path, text: str, complaint: str) -> None:
    (folder / "odd-thing.md").write_text(text)
    with pytest.raises(ValueError, match=complaint):
        rule_table()
