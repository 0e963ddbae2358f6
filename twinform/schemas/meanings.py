"""The meanings of elements and attributes, which are the documentation in the XSDs and in the JSON Schema.

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

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache

from twinform.package_files import package_files
from twinform.schemas.facts import Fact, Table, table

Path = tuple[str, ...]
"""The names from a definition down to a row."""

# In files beside the facts: a sentence for each of 1,100 rows would bury the tables.
_LINE = re.compile(r"(?P<indent> *)(?:= (?P<like>[\w. @]+)|(?P<name>@?[\w.]+): (?P<text>\S.*))")


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
    for path, like in likes:
        below = {(*path, *known[len(like) :]): text for known, text in found.items() if known[: len(like)] == like}
        found |= {each: text for each, text in below.items() if each not in found}
    return found


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
