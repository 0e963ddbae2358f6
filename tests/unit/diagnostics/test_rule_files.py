"""The files of built-in rules, and the table that is made of their heads."""

from pathlib import Path

import pytest

from twinform.diagnostics import catalog, rule_files, rules
from twinform.diagnostics.rule_files import read_head, read_page, rule_names
from twinform.diagnostics.rule_table import rule_line, rule_table

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
    monkeypatch.setattr(rule_files, "_folder", lambda: tmp_path)
    return tmp_path


def test_the_committed_table_is_up_to_date() -> None:
    assert Path(str(rules.__file__)).read_text() == rule_table()
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
