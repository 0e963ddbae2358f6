"""Makes the pages of the elements of each format.

There is one for each type of element, with a row for each element and attribute in it: what the facts tables say of it
and what it means; for URDF and SDF, whose rows have counterparts in each other, also where it goes, the rules, and a
case file that proves it.
"""

from collections.abc import Iterator
from typing import get_args

from generators.mapping.cells import ROOT, became, kind, name_of, rules_seen, versions, where
from generators.mapping.file_rows import holders
from generators.mapping.measure import Seen, measured
from generators.mapping.notes import Note, notes
from testbed.markdown import paragraphs, rule_links
from testbed.markdown import table as markdown_table
from twinform.schemas import table
from twinform.schemas.meanings import meanings
from twinform.server.mapping import FORMATS, FormatName, MappingRow, rows, sections

_LIST = "README"
_ABOUT = """\
Every element and attribute of {title} as it is read and written here, a page for each type of element: type, default
and limits, versions, what it means, what becomes of it in {other}, and a case file that proves it.
[How to read the tables](../../explanation/mapping.md).
"""
_ABOUT_MJCF = """\
Every element and attribute of MJCF as MuJoCo {version} reads it, a page for each type of element: type, default and
limits, versions, and what it means. A test asks MuJoCo of each row. A file declares no version: it is read by the words
of the program. What is no longer read has the version up to which it was.
"""
_HEAD = ["element", "type", "versions", "meaning"]
_GOES = ["where it goes", "in the IR", "rules", "case"]


def pages() -> dict[str, str]:
    """The pages of all formats, and one of each that lists them, by their paths."""
    return {f"{format}/{name}.md": text for format in get_args(FormatName) for name, text in pages_of(format)}


def pages_of(format: FormatName) -> Iterator[tuple[str, str]]:
    """Yield the names and texts of the pages of a format, that of the list first."""
    yield _LIST, _list(format)
    yield from ((name, _page(format, name)) for name in sections(format))


def _list(format: FormatName) -> str:
    other = next(each for each in FORMATS if each != format)
    about = _ABOUT.format(title=format.upper(), other=other.upper())
    if format not in FORMATS:
        about = _ABOUT_MJCF.format(version=table(format).versions[-1])
    listed = ([f"[{name}]({name}.md)", meanings(format).get((name,), "")] for name in sections(format))
    return paragraphs(f"# {format.upper()}", about, markdown_table(["element type", "meaning"], listed)) + "\n"


def _page(format: FormatName, name: str) -> str:
    below = [row for row in rows(format) if row.definition == name]
    head = [*_HEAD, *_GOES] if format in FORMATS else _HEAD
    listed = markdown_table(head, ([*_cells(row)] for row in below)) if below else ""
    own = (_note(note) for note in notes() if (format, name) in note.sections)
    title = f"# {name} ({format.upper()})"
    return paragraphs(title, meanings(format).get((name,), ""), _opening(format, name), listed, *own) + "\n"


def _opening(format: FormatName, name: str) -> str:
    fact = table(format).definitions[name]
    around = ", ".join(f"`{path}`" for path in holders(format, name))
    parts = [f"Stands in {around}." if around else "The root of the file."]
    if fact.type:
        parts.append(f"Its text: {kind(fact)}.")
    if fact.any:
        parts.append("May hold anything else as well." if fact.rows else "May hold anything.")
    elif not fact.rows:
        parts.append("Holds nothing.")
    return " ".join(parts)


def _cells(row: MappingRow) -> Iterator[str]:
    yield name_of(row)
    yield kind(row.fact)
    yield versions(row.fact)
    yield meanings(row.format).get((row.definition, *row.steps.split("/")), "").replace("<", "&lt;")
    if row.format in FORMATS:
        yield from _cells_of_mapping(row, measured().get(row, Seen()))


def _cells_of_mapping(row: MappingRow, seen: Seen) -> Iterator[str]:
    """Yield where a row goes in the other format, its field, its rules and its case."""
    field, goes = where(row, seen)
    yield ": ".join(filter(None, (became(seen), goes)))
    yield field
    yield "; ".join(rules_seen(seen))
    yield f"[{seen.proof.path.rpartition('/')[2]}]({ROOT}/{seen.proof.path})" if seen.proof else ""


def _note(note: Note) -> str:
    about = ", ".join(f"`{path}`" for path in note.paths)
    cases = ", ".join(f"[{path}]({ROOT}/tests/cases/{path})" for path in note.cases)
    links_after = (
        f" {title}: {links}." for title, links in (("Rules", rule_links(note.rules, ROOT)), ("Cases", cases)) if links
    )
    return f"* {about}: {note.text}{''.join(links_after)}"
