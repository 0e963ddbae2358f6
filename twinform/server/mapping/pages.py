"""The pages of the languages: `python -m twinform.server.mapping.pages urdf|sdf FILE [--check]` writes or checks one.

They have what the facts tables say of every element and attribute, what they mean, and where each goes.
"""

import sys
from collections.abc import Iterator

from twinform.diagnostics.generated_files import main
from twinform.schemas import table
from twinform.schemas.facts import Fact, Version
from twinform.schemas.meanings import meanings
from twinform.server.mapping.destinations import destination
from twinform.server.mapping.rows import FORMATS, FormatName, Row, holders, rows, sections

_FIRST, _LAST = (0, 0), (99, 99)
_COUNTS = {"1": "once", "?": "", "*": "any number", "+": "at least one"}
_HEAD = "| element | type | default | versions | meaning | where it goes |"
_INTRODUCTION = """\
# {title}

Every element and attribute of {title} as it is read and written here: type, default and limits, versions, what it
means, and what becomes of it in {other}. Sections are element types; a path begins at the type, `@` is an attribute.
What stands in no version is in all. *Where it goes* is explained, with the rules and a case for each row, in
[where every element goes](../explanation/mapping.md#{format}-{root}).
This file is made by `python -m twinform.server.mapping.pages {format} docs/reference/{format}.md`; do not edit it.
"""


def language_page(format: FormatName) -> str:
    """A format in Markdown."""
    other = next(each for each in FORMATS if each != format)
    head = _INTRODUCTION.format(title=format.upper(), other=other.upper(), format=format, root=table(format).root)
    return "\n".join([head, *(_section(format, name) for name in sections(format))])


def _section(format: FormatName, name: str) -> str:
    used = ", ".join(f"`{path}`" for path in holders(format, name))
    about = [meanings(format).get((name,), ""), f"Stands in {used}." if used else ""]
    lines = [f"## {name}", "", *(f"{part}\n" for part in about if part)]
    below = [row for row in rows(format) if row.definition == name]
    if below:
        lines += [_HEAD, "| --- | --- | --- | --- | --- | --- |"]
        lines += [_line(row) for row in below]
    return "\n".join([*lines, ""])


def _line(row: Row) -> str:
    fact = row.fact
    goes, fates = destination(row)
    name = f"[`{row.steps}`](#{fact.reference})" if fact.reference else f"`{row.steps}`"
    meaning = meanings(row.format).get((row.definition, *row.steps.split("/")), "")
    where = ": ".join(filter(None, (fates, goes)))
    cells = (name, ", ".join(_type(fact)), fact.default or "", _versions(fact), meaning, where)
    return "| " + " | ".join(map(_cell, cells)) + " |"


def _type(fact: Fact) -> Iterator[str]:
    if _COUNTS[fact.count]:
        yield _COUNTS[fact.count]
    if fact.enum:
        yield "one of " + ", ".join(fact.enum)
    elif fact.type:
        yield fact.type
    if fact.unit:
        yield f"in {fact.unit}"
    if fact.min is not None:
        yield f"at least {fact.min:g}"
    if fact.max is not None:
        yield f"at most {fact.max:g}"
    if fact.dialect:
        yield f"of {fact.dialect} alone"
    if fact.deprecated:
        yield "deprecated"


def _versions(fact: Fact) -> str:
    since = f"since {_number(fact.since)}" if fact.since > _FIRST else ""
    until = f"until {_number(fact.until)}" if fact.until < _LAST else ""
    return " ".join(filter(None, (since, until)))


def _number(version: Version) -> str:
    return ".".join(map(str, version))


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("<", "&lt;")


if __name__ == "__main__":
    chosen: FormatName = "urdf" if sys.argv[1] == "urdf" else "sdf"
    sys.exit(main(language_page(chosen), sys.argv[2:]))
