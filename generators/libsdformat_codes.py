"""Makes the page of rules for what libsdformat finds, and for what it does not find.

The case files are searched for those that announce a rule, so the page shows where each one is tried.
"""

import re
import tomllib
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from testbed.corpus.files import ROOT
from testbed.markdown import paragraphs, rule_links, table

CASES = ROOT / "tests" / "cases" / "check"
_EXPECT = re.compile(r"<!--\s*expect:\s*\w+\s+([\w-]+)\s*-->")
_HEAD = "# What libsdformat finds, and what it does not"
_UNSEEN = "## Read without a finding"
_ABOUT = """\
The error codes of libsdformat 17 by name (numbers change between its versions), with the rules that find the same
here and a case file of `tests/cases/check` that shows each. Below it are faults that libsdformat does not find.
"""


class Row(NamedTuple):
    """A code or a fault, the rules for it, and a note where there are none."""

    title: str
    rules: tuple[str, ...] = ()
    note: str = ""


def _rows(table: str) -> tuple[Row, ...]:
    rows = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))[table]
    return tuple(Row(title, tuple(row.get("rules", ())), row.get("note", "")) for title, row in rows.items())


CODES, UNSEEN = _rows("codes"), _rows("unseen")


def page() -> str:
    """The page with both tables."""
    cases = announced()
    unseen = (_UNSEEN, _table("fault", UNSEEN, cases))
    return paragraphs(_HEAD, _ABOUT, _table("code", CODES, cases), *unseen) + "\n"


def announced() -> dict[str, list[str]]:
    """The case files that announce each rule."""
    found: dict[str, list[str]] = defaultdict(list)
    for path in sorted(each for each in CASES.iterdir() if each.is_file() and each.suffix != ".mjcf"):
        for rule in dict.fromkeys(_EXPECT.findall(path.read_text(encoding="utf-8", errors="replace"))):
            found[rule].append(path.name)
    return found


def _table(title: str, rows: tuple[Row, ...], cases: dict[str, list[str]]) -> str:
    found = ((row.title, rule_links(row.rules) or row.note, _shown(row, cases)) for row in rows)
    return table([title, "rules", "cases"], found)


def _shown(row: Row, cases: dict[str, list[str]]) -> str:
    return ", ".join(dict.fromkeys(name for rule in row.rules for name in cases[rule][:2]))
