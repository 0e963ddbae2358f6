"""Rows of the facts tables for the generated pages: which rows a file uses, and which of both formats correspond."""

from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from twinform.ir.versions import Version, parse_version
from twinform.schemas import XmlElement, table
from twinform.schemas.facts import Fact
from twinform.server.mapping import FORMATS, Chain, FormatName, MappingRow, chains_of, rows, sections

_POSE = frozenset({"Pose.xyz", "Pose.rpy", "Pose.quat_xyzw"})


class TablePart(NamedTuple):
    """An element of a file, or one attribute of it, and the row that it is."""

    element: XmlElement
    attribute: str | None
    row: MappingRow


def unreachable(format: FormatName) -> list[str]:
    """Definitions that no row refers to: the specification describes them and gives them no place."""
    reachable = frozenset(sections(format))
    return [name for name in table(format).definitions if name not in reachable]


def holders(format: FormatName, definition: str) -> list[str]:
    """The paths of the rows that refer to a definition, each once."""
    return list(dict.fromkeys(row.path for row in rows(format) if row.fact.reference == definition))


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


def targets(row: MappingRow) -> list[str]:
    """The paths of the rows of the other format that fill the same field, each once."""
    chain = chains_of(row.format).get(row)
    if not chain:
        return []
    other = next(name for name in FORMATS if name != row.format)
    if chain[-1] in _POSE and other == "sdf":
        return ["pose"]
    found = (one.path for one, its in _by_field(other)[chain[-1]] if _fits(chain, its))
    return list(dict.fromkeys(found))


def _fits(one: Chain, other: Chain) -> bool:
    """Whether they name the same field, as far as both state what it is in."""
    return all(a == b for a, b in zip(reversed(one), reversed(other), strict=False))


@cache
def _by_field(format: FormatName) -> dict[str, list[tuple[MappingRow, Chain]]]:
    found: dict[str, list[tuple[MappingRow, Chain]]] = defaultdict(list)
    for row in rows(format):
        if chain := chains_of(format).get(row):
            found[chain[-1]].append((row, chain))
    return found
