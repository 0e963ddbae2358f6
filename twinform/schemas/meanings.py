"""The meanings of elements and attributes, as the documentation in the XSDs.

Beside each `.facts` file lies a `.meanings` file with the same definitions and rows in the same indentation, and a text
behind each name instead of its facts:

    joint: What connects two links, and how they may move.
      @name: What it is called.
      axis: What it turns about or slides along.
        xyz: The direction.
      axis2: The second axis.
        = joint axis

A row with `=` stands for all rows of another place. Versions, units and defaults are facts and no part of the texts; a
name that has several rows, one for each version, has one text.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache

from twinform.ir.versions import parse_version, print_version
from twinform.lazy import lazy_pattern
from twinform.package_files import package_files
from twinform.schemas.facts import Fact, Table, table

Path = tuple[str, ...]
"""The names from a definition down to a row."""

# In files beside the facts: a sentence for each of 1,100 rows would bury the tables.
_LINE = lazy_pattern(r"(?P<indent> *)(?:= (?P<like>[\w. @]+)|(?P<name>@?[\w.]+): (?P<text>\S.*))")


@cache
def meanings(format: str) -> Mapping[Path, str]:
    """The meaning of every definition and row of a format."""
    folder = package_files("twinform.schemas").joinpath(format, "facts")
    files = sorted((file for file in folder.iterdir() if file.name.endswith(".meanings")), key=lambda file: file.name)
    found: dict[Path, str] = {}
    likes: list[tuple[Path, Path]] = []
    for file in files:
        for path, text, like in _parsed(file.read_text(encoding="utf-8").splitlines(), file.name):
            if like:
                likes.append((path, like))
            elif path in found:
                raise ValueError(f"{file.name}: {' '.join(path)} has two meanings")
            else:
                found[path] = text
    for path, like in _innermost_first(likes):
        below = {(*path, *known[len(like) :]): text for known, text in found.items() if known[: len(like)] == like}
        found |= {each: text for each, text in below.items() if each not in found}
    return found


def _innermost_first(likes: list[tuple[Path, Path]]) -> Iterator[tuple[Path, Path]]:
    """Yield rows that stand for other places, each behind those in the place that it stands for."""
    waiting = likes
    while waiting:
        late = [(path, like) for path, like in waiting if any(other[: len(like)] == like for other, _ in waiting)]
        late = late if len(late) < len(waiting) else []  # they stand for each other
        yield from (each for each in waiting if each not in late)
        waiting = late


def rows_with_paths(facts: Table) -> Iterator[tuple[Path, Fact]]:
    """Every definition and row of a table with its path."""
    for name, definition in facts.definitions.items():
        yield from _below(definition, (name,))


def unmatched(format: str) -> tuple[set[Path], set[Path]]:
    """The rows without a meaning, and the meanings without a row."""
    rows = {path for path, _ in rows_with_paths(table(format))}
    known = set(meanings(format))
    return rows - known, known - rows


def _below(fact: Fact, path: Path) -> Iterator[tuple[Path, Fact]]:
    yield path, fact
    for row in fact.rows:
        yield from _below(row, (*path, row.name))


def _parsed(lines: Iterable[str], name: str) -> Iterator[tuple[Path, str, Path]]:
    """Each line of a file: its path, its text, and the place that it refers to instead of having one."""
    path: list[str] = []
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        match = _LINE.fullmatch(line.rstrip())
        depth, odd = divmod(len(match["indent"]), 2) if match else (0, 1)
        if not match or odd or depth > len(path):
            raise ValueError(f"{name}:{number}: not a line of a file of meanings: {line!r}")
        if match["like"]:
            yield tuple(path[:depth]), "", tuple(match["like"].split())
            continue
        path[depth:] = [match["name"]]
        yield tuple(path), match["text"], ()


_UNIT_WORDS = {"kg*m^2": "kg m^2", "N*m": "N m", "kg*m": "kg m"}


class Documentation:
    """The documentation of one format."""

    def __init__(self, facts: Table) -> None:
        self.table = facts
        self.texts = meanings(facts.format)

    def of(self, path: Path, row: Fact, like: Sequence[Fact] = ()) -> str:
        """The documentation of a row; `like` are all rows of its name, one for each group of versions."""
        sentences = [self.texts.get(path, "")]
        if row.names:
            sentences.append(f"The name of {name_one_of(row.names)}.")
        if row.unit is not None:
            sentences.append(f"Unit: {_UNIT_WORDS.get(row.unit, row.unit)}.")
        if row.default is not None:
            sentences.append(f"Default: {row.default}.")
        sentences += self._range(row)
        sentences += self._versions(like or (row,))
        if row.deprecated:
            sentences.append("Deprecated.")
        return " ".join(filter(None, sentences))

    def of_definition(self, name: str) -> str:
        """The documentation of a definition, wherever it is used."""
        return self.texts.get((name,), "")

    def _range(self, row: Fact) -> Iterable[str]:
        if row.min is not None and row.max is not None:
            yield f"From {row.min:g} to {row.max:g}."
        elif row.min is not None:
            yield f"At least {row.min:g}."
        elif row.above is not None:
            yield f"More than {row.above:g}."
        elif row.max is not None:
            yield f"At most {row.max:g}."

    def _versions(self, rows: Sequence[Fact]) -> Iterable[str]:
        since, until = min(row.since for row in rows), max(row.until for row in rows)
        name, first = self.table.format.upper(), parse_version(self.table.versions[0])
        if since > first:
            yield f"Since {name} {print_version(since)}."
        if until < self.table.newest:
            yield f"Until {name} {print_version(until)}."


def name_one_of(names: Sequence[str]) -> str:
    """Write names with an article before the first and `or` before the last: `a body, geom or site`."""
    *most, last = names
    listed = f"{', '.join(most)} or {last}" if most else last
    return f"{'an' if listed[0] in 'aeiou' else 'a'} {listed}"
