"""Which row of the facts tables each element and attribute of a file is."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from typing import Literal, NamedTuple

from twinform.schemas import XmlElement, table
from twinform.schemas.facts import Fact, Version, parse_version

FormatName = Literal["urdf", "sdf"]
FORMATS: tuple[FormatName, ...] = ("urdf", "sdf")


@dataclass(frozen=True, slots=True)
class MappingRow:
    """A row of a table: its definition, the steps from there, and the first version that has it.

    A name may have several rows, one for each span of versions.
    """

    format: FormatName
    definition: str
    steps: str
    since: Version
    fact: Fact = field(compare=False, repr=False)

    @property
    def path(self) -> str:
        """Definition and steps: `link/inertial/mass`."""
        return f"{self.definition}/{self.steps}"


class TablePart(NamedTuple):
    """An element of a file, or one attribute of it, and the row that it is."""

    element: XmlElement
    attribute: str | None
    row: MappingRow


@cache
def rows(format: FormatName) -> tuple[MappingRow, ...]:
    """All rows that a file may use, in the order of the table."""
    reachable = frozenset(sections(format))
    definitions = table(format).definitions.items()
    return tuple(row for name, fact in definitions if name in reachable for row in _rows_below(format, name, fact, ""))


def unreachable(format: FormatName) -> list[str]:
    """Definitions that no row refers to: the specification describes them and gives them no place."""
    reachable = frozenset(sections(format))
    return [name for name in table(format).definitions if name not in reachable]


@cache
def sections(format: FormatName) -> tuple[str, ...]:
    """The definitions that a file may use, from the root outwards."""
    facts = table(format)
    found = [facts.root]
    for name in found:  # it grows in the loop
        for row in _rows_below(format, name, facts.definitions[name], ""):
            if row.fact.reference and row.fact.reference not in found:
                found.append(row.fact.reference)
    return tuple(found)


def holders(format: FormatName, definition: str) -> list[str]:
    """The paths of the rows that refer to a definition, each once."""
    return list(dict.fromkeys(row.path for row in rows(format) if row.fact.reference == definition))


def _rows_below(format: FormatName, definition: str, fact: Fact, around: str) -> Iterator[MappingRow]:
    for below in fact.rows:
        steps = f"{around}{below.name}"
        yield MappingRow(format, definition, steps, below.since, below)
        if not below.reference:
            yield from _rows_below(format, definition, below, f"{steps}/")


def parts(root: XmlElement) -> Iterator[TablePart]:
    """The elements and attributes of a file that are rows of the table of its format and version."""
    format: FormatName = "urdf" if root.tag == "robot" else "sdf"
    facts = table(format)
    default = facts.versions[0 if format == "urdf" else -1]
    version = parse_version(str(root.get("version") or default))
    stack = [(root, facts.root, facts.definitions[facts.root], "")]
    while stack:
        element, definition, fact, around = stack.pop()
        for name in element.attrib:
            if (row := _row(fact, f"@{name}", version)) is not None:
                yield TablePart(
                    element, str(name), MappingRow(format, definition, f"{around}{row.name}", row.since, row)
                )
        for child in element:
            row = _row(fact, str(child.tag), version) if isinstance(child.tag, str) else None
            if row is None:
                continue
            steps = f"{around}{row.name}"
            yield TablePart(child, None, MappingRow(format, definition, steps, row.since, row))
            below = facts.definitions[row.reference] if row.reference else row
            stack.append((child, row.reference or definition, below, "" if row.reference else f"{steps}/"))


def _row(fact: Fact, name: str, version: Version) -> Fact | None:
    return next((row for row in fact.rows if row.name == name and row.exists_in(version)), None)
