"""The notes of the mapping are about things that there are."""

import pytest

from generators.mapping.elements import pages_of
from generators.mapping.file_rows import targets, unreachable
from generators.mapping.measure import CASES
from generators.mapping.notes import Note, destinations, notes
from testbed.corpus.files import ROOT
from twinform.diagnostics.catalog import catalog
from twinform.server.mapping import FORMATS, FormatName, field_of, rows, sections

PAGE = ROOT / "docs/explanation/mapping.md"


def _known(format: FormatName) -> set[str]:
    return {*sections(format), *(row.path for row in rows(format))}


@pytest.mark.parametrize("note", notes(), ids=lambda note: note.about[0])
def test_a_note_names_elements_rules_and_cases_that_there_are(note: Note) -> None:
    known = {f"{format}:{path}" for format in FORMATS for path in _known(format)}
    assert [each for each in note.about if each not in known] == []
    assert [rule for rule in note.rules if rule not in catalog()] == []
    assert [case for case in note.cases if not (CASES / case).is_file()] == []


@pytest.mark.parametrize("format", FORMATS)
def test_where_things_go_is_noted_for_elements_that_there_are(format: FormatName) -> None:
    assert set(destinations(format)) <= _known(format)


def test_links_of_the_page_lead_to_its_sections_and_to_files() -> None:
    text = PAGE.read_text(encoding="utf-8")
    headings = {line.lstrip("# ").lower().replace(" ", "-") for line in text.splitlines() if line.startswith("#")}
    links = {part.partition(")")[0] for part in text.split("](")[1:]}
    inside = {link[1:] for link in links if link.startswith("#")}
    files = {link.partition("#")[0] for link in links if not link.startswith("#")}
    assert inside - headings == set()
    assert [file for file in files if not (PAGE.parent / file).exists()] == []


def test_rows_that_fill_one_field_are_each_others_targets() -> None:
    mass = next(row for row in rows("urdf") if row.path == "link/inertial/mass/@value")
    assert field_of(mass) == "Inertial.mass"
    assert targets(mass) == ["inertial/mass"]
    axis = next(row for row in rows("sdf") if row.path == "joint/axis2/xyz")
    assert targets(axis) == []


def test_only_what_the_specification_gives_no_place_is_left_aside() -> None:
    assert [unreachable(format) for format in FORMATS] == [[], ["robot", "collision_engine"]]


def test_pages_of_mjcf_say_what_each_row_is_and_means() -> None:
    made = dict(pages_of("mjcf"))
    assert [name for name in sections("mjcf") if name not in made] == []
    assert "| `@range` | two numbers, default `0 0` |  | Its lower and its upper limit. |" in made["joint"]
    assert "| `@orthographic` | bool | 3.2 to 3.4 | Whether it has no perspective;" in made["camera"]
    assert "| `@target` | string, the name of a body |  | The body that it looks at. |" in made["camera"]
    assert "| [`body`](body.md) | any number |" in made["body"]
