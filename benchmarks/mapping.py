"""The page that says of each element of both formats where it goes: `make mapping` writes docs/explanation/mapping.md.

Types, versions and places are those of the facts tables, what became of an element is measured on the case files, and
what only words can say stands in `mapping_notes.toml`.
"""

import sys
from collections.abc import Iterable, Iterator

from benchmarks.mapping_cells import became, kind, name_of, rule_links, rules_seen, versions, where
from benchmarks.mapping_lists import passed_over
from benchmarks.mapping_measure import Seen, measured
from benchmarks.mapping_notes import Note, notes
from benchmarks.mapping_rows import FORMATS, FormatName, Row, holders, rows, sections
from benchmarks.markdown import table as markdown_table
from twinform.diagnostics.committed import main
from twinform.schemas import table

_INTRODUCTION = """\
# The mapping: every element of both formats

Where each element and attribute of URDF and SDF goes in the other format, what is kept, changed and refused, and the
case file that proves it. Made by `make mapping` from three sources: the facts tables (types, versions, places in the
IR), the case files under `tests/cases`, each really converted, and `benchmarks/mapping_notes.toml`. Do not edit it.

**How to read it.** One section for each element type, with a row for each element and attribute in it; a path begins
at the type. *Where it goes* names what fills the same field of the IR in the other format. *Became* is what an audit
of the case files found: *expressed* in words of the other format, *carried* in our namespace, *approximated*, or
*dropped* (with `--no-carriers`, all that is carried would be). *Rules* are those that the ledger names there, and the
findings of the case files: what is **refused** stops a conversion. `1` is required, `?` may be left out, `*` and `+`
may repeat.

[What is passed over](#what-is-passed-over) with a word, without one, and what is special stands at the end, the
reasons for all this in [decisions](decisions.md), and the rules in [rules](../reference/rules.md).
"""
_TITLES: dict[FormatName, str] = {"urdf": "From URDF to SDF", "sdf": "From SDF to URDF"}


def page() -> str:
    """The whole page."""
    formats = (part for name in FORMATS for part in _format(name))
    return "\n".join([_INTRODUCTION, *_contents(), *formats, *passed_over()])


def _contents() -> Iterator[str]:
    for name in FORMATS:
        links = ", ".join(f"[{one}](#{name}-{one})" for one in sections(name))
        yield f"**{_TITLES[name]}:** {links}.\n"


def _format(name: FormatName) -> Iterator[str]:
    yield f"## {_TITLES[name]}\n"
    told = notes()
    for definition in sections(name):
        group = [row for row in rows(name) if row.definition == definition]
        own = [note for note in told if (name, definition) in note.sections]
        yield "\n".join(_section(name, definition, group, own))


def _section(name: FormatName, definition: str, group: list[Row], own: list[Note]) -> Iterator[str]:
    yield f"### {name.upper()} {definition}\n"
    yield _opening(name, definition)
    head = ["element", "type", "versions", "in the IR", "where it goes", "became", "rules", "case"]
    if group:
        yield markdown_table(head, (_row(row, measured().get(row, Seen())) for row in group))
    yield from (_note(note) for note in own)


def _opening(name: FormatName, definition: str) -> str:
    fact = table(name).definitions[definition]
    around = ", ".join(f"`{path}`" for path in holders(name, definition))
    parts = [f"Stands in {around}." if around else "The root of the file."]
    if fact.type:
        parts.append(f"Its text is {kind(fact)}.")
    if fact.any:
        parts.append("May hold anything else as well." if fact.rows else "May hold anything.")
    elif not fact.rows:
        parts.append("Holds nothing.")
    return " ".join(parts) + "\n"


def _row(row: Row, seen: Seen) -> list[str]:
    case = f"[{seen.proof.path.rpartition('/')[2]}](../../{seen.proof.path})" if seen.proof else ""
    return [
        name_of(row),
        kind(row.fact),
        versions(row.fact),
        *where(row, seen),
        became(seen),
        "; ".join(rules_seen(seen)),
        case,
    ]


def _note(note: Note) -> str:
    about = ", ".join(f"`{path}`" for path in note.paths)
    tail = _sentence("Rules", rule_links(note.rules)) + _sentence("Cases", map(_case_link, note.cases))
    return f"* {about}: {note.text}{tail}\n"


def _sentence(word: str, links: Iterable[str]) -> str:
    said = ", ".join(links)
    return f" {word}: {said}." if said else ""


def _case_link(path: str) -> str:
    return f"[{path}](../../tests/cases/{path})"


if __name__ == "__main__":
    sys.exit(main(page(), sys.argv[1:]))
