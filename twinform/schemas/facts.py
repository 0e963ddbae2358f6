"""The facts tables: what each format's elements and attributes are, in which versions, and where the IR keeps them.

A table is a folder of `.facts` files. A line without indent opens a *definition*, an element type that others refer to;
below it stand rows, two blanks deeper for each level:

    joint
      @name            1  string                       -> name
      axis             ?                               -> axis
        xyz            ?  vector3   default="0 0 1"    -> xyz
          @expressed_in  ?  string  since=1.7          -> expressed_in
      pose             ?  &pose                        -> pose

A row is a name (with `@` that of an attribute), a count (`1`, `?`, `*`, `+`), a value type or a `&definition` (neither:
a container), then keys, flags and the place in the IR. A line `& definition` stands for all rows of that definition.

Keys are `default`, `min`, `above` (an excluded `min`), `max`, `enum`, `since`, `until`, `unit`, `dialect` (whose
element it is where it is not the format's), `also` (values of dialects beside those of `enum`) and `names` (the
elements of which the value is the name, with `|` between them). Flags are `any`
(free content), `deprecated`, `expected` (readers want it written although it has a default, or its element has no
effect without it), `strict` (a reader refuses what is out of bounds, or no robot can be so), `aside` (readers of the
robot itself skip it) and `last` (where one may stand and several do, readers take the last).

Places are:

* `-> field`: a leaf's value, or a container as a node of its own; where it repeats they make a tuple;
* `-> field[]`: a tuple even where this version has at most one;
* `-> outer.field`: the same, one node further in;
* `-> field:kind`: one of several elements that share a field and differ by kind;
* `-> /field`: a field of the document around the root's node;
* `-> .`: a container that makes no node: its rows fill the node around it;
* nothing: the subtree is kept as an opaque element, and no row in it has a place.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cache
from itertools import chain, pairwise
from operator import itemgetter
from typing import Any, TypeVar

from twinform.dataclass import dataclass
from twinform.ir.versions import Version, parse_version, versions_of
from twinform.lazy import lazy_pattern
from twinform.package_files import package_files

# A notation of our own: Python literals would need four times the lines and a type checker's
# patience, and TOML and CSV cannot nest. It is documented and parsed here only.
_LINE = lazy_pattern(r"(?P<indent> *)(?P<name>@?[\w.]++|&(?= ))(?P<rest>.*)")
_WORD = lazy_pattern(r'->\s*\S+|\w+=(?:"[^"]*"|\S+)|\S+')
_COUNTS = frozenset("1?*+")
_FLAGS = frozenset({"any", "aside", "deprecated", "expected", "last", "strict"})
_ALL_OF = "&"
"""The name of a line that stands for all rows of a definition."""


@dataclass(slots=True)
class Fact:
    """One row: an element or, where the name begins with `@`, an attribute.

    `elsewhere` holds the values that only other versions have among its `enum`, with the row of one of them.
    """

    name: str
    count: str = "1"
    type: str | None = None
    reference: str | None = None
    place: str | None = None
    kind: str | None = None
    default: str | None = None
    enum: tuple[str, ...] = ()
    elsewhere: dict[str, "Fact"] = field(default_factory=dict[str, "Fact"])
    min: float | None = None
    above: float | None = None
    max: float | None = None
    unit: str | None = None
    dialect: str | None = None
    also: tuple[tuple[str, str], ...] = ()
    names: tuple[str, ...] = ()
    since: Version = (0, 0)
    until: Version = (99, 99)
    any: bool = False
    deprecated: bool = False
    expected: bool = False
    strict: bool = False
    aside: bool = False
    last: bool = False
    many: bool = False
    rows: list["Fact"] = field(default_factory=list["Fact"])

    @property
    def is_attribute(self) -> bool:
        """Whether it is an attribute rather than an element."""
        return self.name.startswith("@")

    @property
    def required(self) -> bool:
        """Whether it must be written."""
        return self.count in "1+"

    @property
    def needs_text(self) -> bool:
        """Whether blank text is a mistake rather than another way to write the default."""
        # The SDF specification requires 175 elements, and readers fill in nearly all of them.
        # Required here is only what has no useful default: names, types, parents, children, URIs.
        return self.required and self.default is None

    @property
    def bounds(self) -> tuple[float, float] | None:
        """The least and the greatest allowed number, also for each component; None where any number is allowed."""
        if self.min is self.above is self.max is None:
            return None
        low = self.min if self.above is None else math.nextafter(self.above, math.inf)
        return -math.inf if low is None else low, math.inf if self.max is None else self.max

    @property
    def repeats(self) -> bool:
        """Whether it may be written more than once."""
        return self.count in "*+"

    @property
    def fills_tuple(self) -> bool:
        """Whether its field in the IR is a tuple of nodes or values."""
        return (self.repeats or self.many) and self.kind is None

    @property
    def attributes(self) -> list["Fact"]:
        """The rows of its attributes."""
        return [row for row in self.rows if row.is_attribute]

    @property
    def children(self) -> list["Fact"]:
        """The rows of its child elements."""
        return [row for row in self.rows if not row.is_attribute]

    def exists_in(self, version: Version) -> bool:
        """Tell whether this version of the format has it."""
        return self.since <= version <= self.until


@dataclass(frozen=True, slots=True)
class Table:
    """The facts of one format: definitions by name, the root's first."""

    format: str
    versions: tuple[str, ...]
    root: str
    definitions: Mapping[str, Fact]

    def resolve(self, row: Fact) -> Fact:
        """Return the fact that holds a row's rows: the definition that it refers to, or itself."""
        return self.definitions[row.reference] if row.reference else row

    @property
    def newest(self) -> Version:
        """The newest version that the table knows."""
        return parse_version(self.versions[-1])


_ROOTS = {"urdf": "robot", "sdf": "sdf", "mjcf": "mujoco"}


@cache
def table(format: str) -> Table:
    """The facts of a format."""
    folder = package_files("twinform.schemas").joinpath(format, "facts")
    files = sorted((file for file in folder.iterdir() if file.name.endswith(".facts")), key=lambda file: file.name)
    definitions = FactDefinitions()
    for file in files:
        definitions.add(file.read_text(encoding="utf-8").splitlines(), file.name)
    return Table(format, versions_of(format), _ROOTS[format], definitions)


class FactDefinitions(Mapping[str, Fact]):
    """Definitions by name, each parsed when somebody first asks for it: a run needs few of them."""

    def __init__(self) -> None:
        self._lines: dict[str, tuple[Sequence[str], str, int]] = {}
        self._parsed: dict[str, Fact] = {}

    def add(self, lines: Sequence[str], file: str) -> None:
        """Add the definitions in the lines of a `.facts` file.

        Raises:
            ValueError: a definition has the name of another one.
        """
        starts = [number for number, line in enumerate(lines) if line[:1] not in {"", " ", "#"}]
        for start, end in pairwise([*starts, len(lines)]):
            name = lines[start].split(maxsplit=1)[0]
            if name in self._lines:
                raise ValueError(f"{file}: {name} is defined twice")
            self._lines[name] = lines[start:end], file, start + 1

    def __getitem__(self, name: str) -> Fact:
        if name not in self._parsed:
            self._parsed[name] = fact = next(parse_facts(*self._lines[name]))
            self._fill_in(fact)
            _note_other_words(fact)
        return self._parsed[name]

    def _fill_in(self, fact: Fact) -> None:
        """Put the rows of other definitions where a fact refers to all of them."""
        for row in fact.rows:
            self._fill_in(row)
        if any(row.name == _ALL_OF for row in fact.rows):
            groups = [self[row.reference or ""].rows if row.name == _ALL_OF else [row] for row in fact.rows]
            fact.rows[:] = chain.from_iterable(groups)

    def __iter__(self) -> Iterator[str]:
        return iter(self._lines)

    def __len__(self) -> int:
        return len(self._lines)


def parse_facts(lines: Iterable[str], name: str, first: int = 1) -> Iterator[Fact]:
    """Yield the definitions in lines of a `.facts` file, of which `first` is the number of the first one.

    Raises:
        ValueError: a line is not in the notation, or has a field that nothing leads to; the message names it.
    """
    stack: list[Fact] = []
    for number, line in enumerate(lines, first):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        match = _LINE.fullmatch(line.rstrip())
        depth, odd = divmod(len(match["indent"]), 2) if match else (0, 1)
        if not match or odd or depth > len(stack):
            raise ValueError(f"{name}:{number}: not a row of a facts table: {line!r}")
        fact = _fact(match["name"], _WORD.findall(match["rest"]), f"{name}:{number}")
        if depth == 0:
            if stack:
                yield stack[0]
        else:
            if fact.place and depth > 1 and not stack[depth - 1].place:
                around = f"<{stack[depth - 1].name}> around it is not: it needs a place too, `-> .` if it makes no node"
                raise ValueError(f"{name}:{number}: {fact.name} is kept in a field, and {around}")
            stack[depth - 1].rows.append(fact)
        stack[depth:] = [fact]
    if stack:
        yield stack[0]


def _fact(name: str, words: list[str], where: str) -> Fact:
    fact = Fact(name)
    for word in words:
        key, equals, value = word.partition("=")
        if word.startswith("->"):
            place, _, kind = word[2:].strip().partition(":")
            fact.place, fact.kind, fact.many = place.removesuffix("[]"), kind or None, place.endswith("[]")
        elif word in _COUNTS:
            fact.count = word
        elif word in _FLAGS:
            setattr(fact, word, True)
        elif word.startswith("&"):
            fact.reference = word[1:]
        elif name == _ALL_OF:
            fact.reference = word
        elif equals:
            _set(fact, key, value.strip('"'), where)
        elif fact.type is None:
            fact.type = word
        else:
            raise ValueError(f"{where}: {word!r} is not known here")
    return fact


def _set(fact: Fact, key: str, value: str, where: str) -> None:
    match key:
        case "default" | "unit" | "dialect":
            setattr(fact, key, value)
        case "min" | "above" | "max":
            setattr(fact, key, float(value.split(maxsplit=1)[0]))  # of a vector, all components have one bound
        case "since" | "until":
            setattr(fact, key, parse_version(value))
        case "enum" | "names":
            setattr(fact, key, tuple(value.split("|")))
        case "also":
            pairs = [word.partition(":") for word in value.split("|")]
            fact.also = tuple((word, dialect) for word, _, dialect in pairs)
        case _:
            raise ValueError(f"{where}: {key!r} is not a key of a facts table")


def _note_other_words(fact: Fact) -> None:
    """Give each row the values that rows of the same name have in other versions, the nearest row of each last."""
    for row in fact.rows:
        if row.enum:
            same = [other for other in fact.rows if other.name == row.name]
            before = [other for other in same if other.until < row.since]
            others = [*before, *reversed(same[len(before) :])]
            row.elsewhere = {word: other for other in others for word in other.enum if word not in row.enum}
        _note_other_words(row)


@cache
def named_kinds(format: str) -> Mapping[str, str]:
    """Return the kind of part that each attribute names, for a format where attributes of one name mean one kind."""
    found: dict[str, str] = {}
    waiting = list(table(format).definitions.values())
    while waiting:
        row = waiting.pop()
        waiting += row.rows
        if row.is_attribute and len(row.names) == 1:
            found[row.name.removeprefix("@")] = row.names[0]
    return found


def in_version(fact: Fact, version: Version) -> Fact:
    """Copy a fact with only the rows that a version has, at every depth."""
    return replace(fact, rows=[in_version(row, version) for row in fact.rows if row.exists_in(version)])


def rows_by_name(rows: Iterable[Fact], version: Version) -> dict[str, Fact]:
    """Choose one row for each name: the one of this version, otherwise the last of another."""
    best: dict[str, Fact] = {}
    for row in rows:
        # A file may use an element that only another version has. It is read by that row, and
        # reported.
        if row.name not in best or not best[row.name].exists_in(version):
            best[row.name] = row
    return best


_Each = TypeVar("_Each")


def rows_to_write(rows: Iterable[Fact], version: Version) -> list[Fact]:
    """Choose one row with a place in the node for each name: this version's if it has one."""
    placed = (row for row in rows if row.place and row.place[0] != "/")
    return list(rows_by_name(placed, version).values())


def makes_many(row: Fact) -> bool:
    """Tell whether the field of a row holds any number of nodes, written in the order of the file."""
    return row.fills_tuple and row.type is None


@cache
def repeated_fields(format: str, definition: str) -> tuple[str, ...]:
    """The fields of a definition that hold any number of nodes, in the order in which they are written."""
    facts = table(format)
    if definition not in facts.definitions:
        return ()
    rows = rows_to_write(facts.definitions[definition].rows, facts.newest)
    return tuple(row.place or "" for row in rows if makes_many(row))


def in_order(items: list[tuple[Any, _Each]]) -> list[tuple[Any, _Each]]:
    """Sort children by the lines that they came from; one without a line of this file follows the one before it."""
    if len(items) < 2:
        return items
    keys: list[int] = []
    file, line = None, 0
    for child, _ in items:
        source = child.source
        if source is not None:
            file = source.file if file is None else file
            line = source.line if source.file == file else line
        # Links and joints are separate tuples in the IR, but most authors write them in turns.
        keys.append(line)
    return [item for _, item in sorted(zip(keys, items, strict=True), key=itemgetter(0))]
