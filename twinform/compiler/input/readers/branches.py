"""What a generated reader does with one attribute or child: conditions, and what follows where they hold."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from twinform.compiler.input.readers import templates
from twinform.schemas import Fact, Version

SCALARS = frozenset({"double", "int", "uint"})
PARSERS = {
    "urdf": {
        "double": "double",
        "int": "integer",
        "uint": "natural",
        "vector3": "vector3",
        "quaternion": "quaternion",
        "color4": "color4",
    },
    "sdf": {
        "double": "loose_double",
        "int": "integer",
        "uint": "natural",
        "vector2d": "vector2d",
        "vector3": "vector3",
        "color": "color",
    },
}
"""The function in `values.py` for each type of a format that is parsed; the others are text."""


@dataclass(frozen=True, slots=True)
class Branch:
    """One branch of a chain, in the versions that have it."""

    conditions: tuple[str, ...]
    body: str
    versions: frozenset[Version] = frozenset()

    def text(self, known: Sequence[Version]) -> str:
        """The branch, guarded where not all known versions have it."""
        guards = [guard(self.versions, known)] if len(self.versions) < len(known) else []
        first, *others = self.conditions
        return f"elif {' and '.join([first, *guards, *others])}:\n{indented(self.body)}"


def chain(branches: Iterable[Branch], known: Sequence[Version]) -> str:
    """The branches one after the other."""
    return "\n".join(branch.text(known) for branch in branches).removeprefix("el")


def merged(branches: Iterable[Branch]) -> list[Branch]:
    """Merge branches that differ in their versions only."""
    found: dict[tuple[tuple[str, ...], str], Branch] = {}
    for branch in branches:
        key = branch.conditions, branch.body
        before = found.get(key, branch)
        found[key] = replace(branch, versions=before.versions | branch.versions)
    return list(found.values())


def guard(versions: Iterable[Version], known: Sequence[Version]) -> str:
    """The condition that the version is one of these."""
    wanted = frozenset(versions)
    runs: list[list[Version]] = []
    for before, version in zip((None, *known), known, strict=False):
        if version in wanted:
            if before not in wanted:
                runs.append([])
            runs[-1].append(version)
    text = " or ".join(_run(run[0], run[-1], known) for run in runs)
    return f"({text})" if len(runs) > 1 else text


def _run(first: Version, last: Version, known: Sequence[Version]) -> str:
    if first == known[0]:
        return f"reading.version <= {last}"
    return f"reading.version >= {first}" if last == known[-1] else f"{first} <= reading.version <= {last}"


def value_conditions(row: Fact, format: str, text: str, string: str) -> tuple[list[str], str]:
    """The conditions under which a value is usual, and the value.

    `text` is the expression for the text, and `string` the one for a value that is text.
    """
    if row.enum:
        listed = set_of(row.enum)
        return ([f"{text} in {listed}"], text) if string == text else ([f"(value := {string}) in {listed}"], "value")
    if row.type == "string":
        return ([], text) if string == text else ([f"(value := {string}) is not None"], "value")
    if row.type == "bool":
        return [f"(value := BOOLS.get({text})) is not None"], "value"
    parser = PARSERS[format][str(row.type)]
    return [f"(value := {parser}({text})) is not None", *_bounds(row)], "value"


def _bounds(row: Fact) -> list[str]:
    low, high = ("value", "value") if row.type in SCALARS else ("min(value)", "max(value)")
    least = [] if row.min is None else [f"{low} >= {row.min!r}"]
    return least if row.max is None else [*least, f"{high} <= {row.max!r}"]


def store(row: Fact, element: str, value: str) -> str:
    """What puts a value into its field."""
    outer, _, field = str(row.place).rpartition(".")
    if outer:
        return templates.SET_INNER_VALUE.format(outer=outer, field=field, element=element, value=value)
    template = templates.APPEND_VALUE if row.fills_tuple else templates.SET_VALUE
    return template.format(field=field, value=value)


def set_of(values: Iterable[str]) -> str:
    """Strings as Python writes a set."""
    return "{" + ", ".join(map(repr, values)) + "}"


def indented(text: str) -> str:
    """The lines one level deeper."""
    return "\n".join(f"    {line}" if line else line for line in text.strip("\n").split("\n"))
