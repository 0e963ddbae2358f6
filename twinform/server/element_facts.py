"""What the facts tables say of one element, as values for programs: places, attributes, children, types, versions."""

from collections.abc import Iterator
from typing import Any

from twinform.diagnostics import did_you_mean
from twinform.schemas import Fact, parse_version, print_version, table
from twinform.schemas.meanings import meanings
from twinform.server.mapping import FormatName, MappingRow, rows
from twinform.server.schema import SchemaPlace, inside, root_place

Facts = dict[str, Any]


def element_facts(format: FormatName, element: str, version: str = "") -> Facts:
    """Return the places where an element may stand in a version of a format, and what may be in it there.

    `element` is a name, or the end of a path where several elements share one, such as `axis/limit`.

    Raises:
        ValueError: there is no such version, or no such element in it.
    """
    facts = table(format)
    if version and version not in facts.versions:
        raise ValueError(f"{format.upper()} has no version {version!r}; it has {', '.join(facts.versions)}")
    wanted = parse_version(version) if version else facts.newest
    known = [row for row in rows(format) if not row.fact.is_attribute and row.fact.exists_in(wanted)]
    places = [inside(row, wanted) for row in known if f"/{row.path}".endswith(f"/{element}")]
    if element == facts.root:
        places.insert(0, root_place(format, wanted))
    if not places:
        hint = did_you_mean(element, {row.fact.name for row in known}) or f"begin at {facts.root!r}"
        raise ValueError(f"{format.upper()} {print_version(wanted)} has no element {element!r}; {hint}")
    version = print_version(wanted)
    return {"format": format, "version": version, "element": element, "places": [*map(_describe_place, places)]}


def _describe_place(place: SchemaPlace) -> Facts:
    row, texts = place.row, meanings(place.format)
    below = [each for each in place.known() if each.exists_in(place.version)]

    def listed(facts: list[Fact]) -> list[Facts]:
        paths = ((place.definition, *f"{place.around}{each.name}".split("/")) for each in facts)
        return [_describe(each, texts.get(path, "")) for each, path in zip(facts, paths, strict=True)]

    return {
        "path": row.path if row else place.definition,
        "parents": sorted({*_parents(row)}) if row else [],
        **(_describe(row.fact, texts.get((row.definition, *row.steps.split("/")), "")) if row else {}),
        "attributes": listed([each for each in below if each.is_attribute]),
        "children": listed([each for each in below if not each.is_attribute]),
        "anything_else": place.inside.any,
    }


def _parents(row: MappingRow) -> Iterator[str]:
    """Yield the names of the elements that a row may stand in."""
    *around, _ = row.steps.split("/")
    if around:
        yield around[-1]
        return
    yield from (each.fact.name for each in rows(row.format) if each.fact.reference == row.definition)
    if row.definition == table(row.format).root:
        yield row.definition


def _describe(fact: Fact, meaning: str) -> Facts:
    """Return what a row says; what it does not say is left out."""
    said: Facts = {
        "meaning": meaning,
        "type": fact.type,
        "default": fact.default,
        "unit": fact.unit,
        "values": [*fact.enum, *(value for value, _ in fact.also)],
        "min": fact.min,
        "above": fact.above,
        "max": fact.max,
        "dialect": fact.dialect,
        "deprecated": fact.deprecated,
        "repeats": fact.repeats,
    }
    named = {"name": fact.name.removeprefix("@"), "required": fact.required}
    return named | {key: value for key, value in said.items() if value not in (None, "", [])}
