"""The cells of the tables of the mapping."""

from collections.abc import Iterator

from generators.mapping.file_rows import targets
from generators.mapping.measure import EXPRESSED, Seen
from generators.mapping.notes import destinations
from testbed.markdown import rule_links
from twinform.diagnostics import Fate, Severity
from twinform.ir.versions import print_version
from twinform.schemas.facts import Fact
from twinform.schemas.meanings import name_one_of
from twinform.schemas.value_types import type_name
from twinform.server.mapping import MappingRow, field_of

ROOT = "../../.."
"""From a page to the root of the repository."""
_COUNTS = {"1": "once", "?": "", "*": "any number", "+": "at least one"}
_LABELS: dict[Severity, str] = {Severity.ERROR: "**refused:** ", Severity.WARNING: "warning: ", Severity.INFO: "note: "}


def name_of(row: MappingRow) -> str:
    """The steps of a row, linked to the page of its type where it has one of its own."""
    if not row.fact.reference:
        return f"`{row.steps}`"
    return f"[`{row.steps}`]({row.fact.reference}.md)"


def kind(fact: Fact) -> str:
    """How often a row may stand, its type, unit, bounds, default, dialect and enumerated values."""
    return ", ".join(_kind(fact))


def _kind(fact: Fact) -> Iterator[str]:
    if _COUNTS[fact.count]:
        yield _COUNTS[fact.count]
    if fact.enum:
        yield "one of " + ", ".join(fact.enum)
    elif fact.type or fact.any:
        yield type_name(fact.type) if fact.type else "anything"
    if fact.names:
        yield f"the name of {name_one_of(fact.names)}"
    if fact.unit:
        yield f"in {fact.unit}"
    if fact.min is not None:
        yield f"at least {fact.min:g}"
    if fact.above is not None:
        yield f"more than {fact.above:g}"
    if fact.max is not None:
        yield f"at most {fact.max:g}"
    if fact.default is not None:
        yield f"default `{fact.default}`" if fact.default else "empty by default"
    yield from (f"{value} ({dialect})" for value, dialect in fact.also)


def versions(fact: Fact) -> str:
    """From when to when there is such a thing; empty for always. Those of dialects are in no version."""
    if fact.dialect:
        return f"dialect: {fact.dialect}"
    since = f"{print_version(fact.since)} on" if fact.since > (0, 0) else ""
    until = f"to {print_version(fact.until)}" if fact.until < (99, 99) else ""
    text = since.replace(" on", f" {until}") if since and until else since + until
    return f"{text}, deprecated" if fact.deprecated else text


def where(row: MappingRow, seen: Seen) -> tuple[str, str]:
    """The field of the IR, and what expresses it in the other format."""
    field = field_of(row) or ("kept as it is" if row.fact.place is None else "(its rows)")
    other = "sdf" if row.format == "urdf" else "urdf"
    if (text := destinations(row.format).get(row.path)) is not None:
        return field, text
    if found := targets(row):
        return field, ", ".join(f"[`{path}`](../{other}/{path.partition('/')[0]}.md)" for path in found)
    return field, _by_fate(row, seen)


def _by_fate(row: MappingRow, seen: Seen) -> str:
    if row.fact.place == ".":
        return "by its rows"
    if not seen.fates:
        return ""
    if EXPRESSED in seen.fates:
        return "`<gazebo>`, as it is" if row.format == "sdf" else "SDF in its place"
    return "a carrier" if Fate.CARRIED in seen.fates else ""


def became(seen: Seen) -> str:
    """The fates that it met, the most frequent first."""
    return " or ".join(fate for fate, _ in sorted(seen.fates.items(), key=lambda each: (-each[1], each[0])))


def rules_seen(seen: Seen) -> Iterator[str]:
    """The rules of the ledger first, then those of findings, the worst first."""
    if seen.ledger:
        yield rule_links(sorted(seen.ledger), ROOT)
    for severity in sorted(set(seen.rules.values()), reverse=True):
        own = sorted(rule for rule, each in seen.rules.items() if each is severity and rule not in seen.ledger)
        if own:
            yield _LABELS[severity] + rule_links(own, ROOT)
