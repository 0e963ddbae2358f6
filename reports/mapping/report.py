"""The page that lists where each element of both formats goes.

Types, versions and places are those of the facts tables, what became of an element is measured on the case files, and
what only prose can express is in `notes.toml`.
"""

from collections.abc import Iterator

from reports.harness.pages import rule_links
from reports.harness.pages import table as markdown_table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from reports.mapping.cells import became, kind, name_of, rules_seen, versions, where
from reports.mapping.lists import passed_over
from reports.mapping.measure import Seen, measured
from reports.mapping.notes import Note, notes
from twinform.schemas import table
from twinform.server.mapping.rows import FORMATS, FormatName, Row, holders, rows, sections

_ABOUT = """\
Where each element and attribute of URDF and SDF goes in the other format, what is kept, changed and refused, and the
case file that proves it. The sources are three: the facts tables (types, versions, places in the IR), the case files
under `tests/cases`, each really converted, and `reports/mapping/notes.toml`. Do not edit it.

**How to read it.** One section for each element type, with a row for each element and attribute in it; a path begins
at the type. *Where it goes* names what fills the same field of the IR in the other format. *Became* is what an audit
of the case files found: *expressed* in elements of the other format, *carried* in our namespace, *approximated*, or
*dropped* (with `--no-carriers`, all that is carried would be). *Rules* are those that the ledger names there, and the
findings of the case files: what is **refused** stops a conversion. `1` is required, `?` may be left out, `*` and `+`
may repeat.

[What is passed over](#what-is-passed-over) with a finding, without one, and what is special stands at the end, the
reasons for all this in [decisions](decisions.md), and the rules in [rules](../reference/rules.md).
"""
_TITLES: dict[FormatName, str] = {"urdf": "From URDF to SDF", "sdf": "From SDF to URDF"}


def measure(_: Sample) -> Findings:
    """The whole page."""
    formats = (part for name in FORMATS for part in _format(name))
    return Findings(["\n".join([*_contents(), *formats, *passed_over()])], f"{len(measured())} rows seen in case files")


def _contents() -> Iterator[str]:
    for name in FORMATS:
        links = ", ".join(f"[{one}](#{name}-{one})" for one in sections(name))
        yield f"**{_TITLES[name]}:** {links}.\n"


def _format(name: FormatName) -> Iterator[str]:
    yield f"## {_TITLES[name]}\n"
    all_notes = notes()
    for definition in sections(name):
        group = [row for row in rows(name) if row.definition == definition]
        own = [note for note in all_notes if (name, definition) in note.sections]
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
    measured = (became(seen), "; ".join(rules_seen(seen)), case)
    return [name_of(row), kind(row.fact), versions(row.fact), *where(row, seen), *measured]


def _note(note: Note) -> str:
    about = ", ".join(f"`{path}`" for path in note.paths)
    cases = ", ".join(f"[{path}](../../tests/cases/{path})" for path in note.cases)
    links_after = (
        f" {title}: {links}." for title, links in (("Rules", rule_links(note.rules)), ("Cases", cases)) if links
    )
    return f"* {about}: {note.text}{''.join(links_after)}\n"


REPORT = Report(
    "mapping", "The mapping: every element of both formats", _ABOUT, measure, needs=(), folder="explanation"
)
