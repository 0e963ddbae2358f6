"""What the report on the corpus knows, and counts."""

import tomllib
from pathlib import Path

import pytest

from reports.harness.known import Known
from reports.text_survives.corpus import why_not_converted
from reports.text_survives.mismatches import by_path
from testbed.corpus.files import ROOT
from twinform.testing.properties import Mismatch

KNOWN = """
[not_converted]
b = "so"
[not_converted_rules]
one = "first"
two = "second"
"""


def test_a_file_is_explained_by_itself_or_by_all_of_its_rules(tmp_path: Path):
    file = tmp_path / "known.toml"
    file.write_text(KNOWN)
    known = Known(file)
    assert why_not_converted(known, "b", ("three",)) == "so"
    assert why_not_converted(known, "c", ("one", "two")) == "first; second"
    assert why_not_converted(known, "c", ("one", "three")) == ""


@pytest.mark.parametrize("report", ["corpus", "versions"])
def test_the_tables_of_reasons_hold_files_that_there_are(corpus: Path, report: str):
    tables = tomllib.loads(next((ROOT / "reports").glob(f"*/{report}.toml")).read_text())
    names = [name for title, table in tables.items() if not title.endswith("_rules") for name in table]
    assert [name for name in names if not any(corpus.glob(name))] == []


def test_mismatches_are_counted_by_kind_and_path_without_names():
    lost = [Mismatch("missing", f"/robot/link[@name='{name}']/@type", f"{name} is not back") for name in "abc"]
    assert by_path([("y", lost[1:]), ("x", [*lost[:1], Mismatch("order", "/robot/joint[2]", "order")])]) == [
        (2, 3, "missing", "/robot/link/@type", "x: a is not back"),
        (1, 1, "order", "/robot/joint", "x: order"),
    ]
