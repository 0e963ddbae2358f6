"""Changes of one value in a file, each to another one that is as good: what a comparison has to notice."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any, cast

from lxml import etree

from testbed.not_compared import NOT_COMPARED
from twinform.compiler import CompileError
from twinform.compiler.build_normal_form import extension_rows
from twinform.compiler.compare import diff
from twinform.compiler.input.front_ends import declared_version
from twinform.compiler.input.loading import LoadOptions, read
from twinform.diagnostics import DiagnosticSink
from twinform.ir.defaults import UNLIMITED
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX
from twinform.schemas import Fact, Version, XmlElement, rows_by_name, table

_FORMATS = {"robot": "urdf", "sdf": "sdf", "mujoco": "mjcf"}
_NOT_VALUES = frozenset({("sdf", "version"), ("robot", "version")})
"""Attributes that say how a file is written."""
_CLASSES = "default"
"""The element of MJCF whose values count where others have its class and no value of their own."""
_ROUNDING = 1e-9
"""Less than this is no more than what rounding leaves."""
_SHARES = frozenset({"color", "color4"})
_SWITCHES = {"true": "false", "false": "true", "1": "0", "0": "1"}


@dataclass(frozen=True, slots=True)
class Spot:
    """A value in a file: the text of an element or, with a name, an attribute of it; `row` is None in free content."""

    element: XmlElement
    name: str
    row: Fact | None

    @property
    def value(self) -> str:
        """What is written."""
        return str(self.element.get(self.name)) if self.name else (self.element.text or "")

    @property
    def path(self) -> str:
        """The tags down to it."""
        tags = [str(each.tag) for each in reversed([self.element, *self.element.iterancestors()])]
        return "/".join([*tags, f"@{self.name}"] if self.name else tags)

    @property
    def is_direction(self) -> bool:
        """Whether it is a vector whose length means nothing."""
        if self.path.startswith("mujoco/"):
            return self.name in {"axis", "zaxis"}
        return self.path.endswith(("axis/xyz", "axis2/xyz", "axis/@xyz"))

    def write(self, value: str) -> None:
        """Put another value there."""
        if self.name:
            self.element.set(self.name, value)
        else:
            self.element.text = value


def spots(root: XmlElement) -> list[Spot]:
    """Every value in the tree of a file that `check` has read."""
    return [
        spot for each in described(root) for spot in _spots(each) if not spot.path.startswith(f"mujoco/{_CLASSES}/")
    ]


@dataclass(frozen=True, slots=True)
class Described:
    """An element with what the tables say of it: its own fact, and the rows of its attributes and children."""

    element: XmlElement
    fact: Fact | None
    rows: Mapping[str, Fact]


def described(root: XmlElement) -> Iterator[Described]:
    """Every element of a file, the free content of plugins too."""
    format = _FORMATS[str(root.tag)]
    version = declared_version(root, format, DiagnosticSink())
    facts = table(format)
    return _described(root, facts.definitions[facts.root], format, version)


def _described(element: XmlElement, row: Fact | None, format: str, version: Version) -> Iterator[Described]:
    fact = table(format).resolve(row) if row else None
    rows = rows_by_name(fact.rows, version) if fact else {}
    if fact is not None and fact.name == "gazebo":
        format, version, rows = "sdf", table("sdf").newest, rows | extension_rows()
    yield Described(element, fact, rows)
    for child in element:
        if isinstance(child.tag, str):
            yield from _described(child, rows.get(child.tag), format, version)


def _spots(each: Described) -> Iterator[Spot]:
    element = each.element
    for name in element.attrib:
        if (element.tag, name) not in _NOT_VALUES:
            yield Spot(element, str(name), each.rows.get(f"@{name}"))
    if not len(element) and (element.text or "").strip():
        yield Spot(element, "", each.fact)


def others(spot: Spot, random: Random) -> Iterator[str]:
    """Other values for a place, of which a reader may refuse some."""
    words, row = spot.value.split(), spot.row
    if row is not None and row.enum:
        yield from (each for each in row.enum if each != spot.value.strip())
    if len(words) == 1 and words[0] in _SWITCHES and (row is None or row.type == "bool"):
        yield _SWITCHES[words[0]]
    elif words and all(map(is_number, words)) and spot.is_direction:
        yield from ("0 0 1", "0 1 0") if words[0] != "0" else ("1 0 0", "0.6 0 0.8")
    elif words and all(map(is_number, words)):
        place = random.randrange(len(words))
        for other in _other_numbers(float(words[place]), share=row is not None and row.type in _SHARES):
            yield " ".join([*words[:place], other, *words[place + 1 :]])
    else:
        yield f"{spot.value.strip()}_other"


def _other_numbers(number: float, *, share: bool) -> Iterator[str]:
    if math.isnan(number):
        yield "0.1"  # what is computed from it would be the same again
        return
    if share:
        yield f"{number - 0.25 if number >= 0.5 else number + 0.25:.9g}"
    if abs(number) >= UNLIMITED:
        yield "7"
    if 0 < abs(number) < _ROUNDING:
        yield from ("0.1", "-0.1")
    if number.is_integer() and abs(number) < 1e6:
        yield from (f"{number + step:.0f}" for step in (2, 1, -1))
    yield from (f"{number * 1.1 or 0.1:.9g}", f"{number * 0.9 or -0.1:.9g}", f"{number + 0.1:.9g}")


def is_number(word: str) -> bool:
    """Whether a word is a number, as Python reads it."""
    try:
        float(word)
    except ValueError:
        return False
    return "_" not in word


def why_not_compared(spot: Spot) -> str:
    """What documents that a change at a place makes no difference; empty where nothing does."""
    tree, around = spot.element.getroottree(), (spot.element, *spot.element.iterancestors())
    again = _standing_again(tree.getroot())

    def stands_again(_: object, nodes: list[XmlElement]) -> bool:
        return nodes[0] in again

    for entry in NOT_COMPARED:
        functions = {(NAMESPACE, "stands-again"): stands_again}
        xpath = etree.XPath(entry.xpath, namespaces={PREFIX: NAMESPACE}, extensions=functions)
        for found in cast("list[Any]", xpath(tree)):
            if isinstance(found, str):
                if found.getparent() is spot.element and (found.attrname or "") == spot.name:  # pyright: ignore[reportAttributeAccessIssue, reportUnknownMemberType] - what lxml makes of an attribute
                    return entry.what
            elif any(found is each for each in around):
                return entry.what
    return ""


def _standing_again(root: XmlElement) -> set[XmlElement]:
    """The elements of a file behind another one of their name where the table allows one."""
    return {
        child
        for each in described(root)
        for name, row in each.rows.items()
        if not row.repeats and not name.startswith("@")
        for child in each.element.findall(name)[1:]
    }


@dataclass(frozen=True, slots=True)
class Mutant:
    """A changed value of a file: `verdict` is the severity of what was found, a documented exception, or `missed`."""

    path: Path
    place: str
    old: str
    new: str
    verdict: str

    @property
    def name(self) -> str:
        """Which one it is."""
        return f"{self.path.name}: {self.place}: {self.old!r} -> {self.new!r}"


MISSED = "missed"
_TRIES = 4
"""Places for each change that is wanted: readers refuse some changes of all kinds, such as of names."""


def mutants(path: Path, size: int, seed: int, paths: Iterable[Path] = ()) -> Iterator[Mutant]:
    """So many values of a file changed, one at a time, each at another kind of place, and compared with the file."""
    root = tree_of(path, paths)
    if root is None:
        return
    random, kinds = Random(f"{path.name}{seed}"), defaultdict[str, list[Spot]](list)
    for spot in spots(root):
        kinds[spot.path].append(spot)
    tried = (_tried(path, root, random.choice(kinds[kind]), random, paths) for kind in shuffled(sorted(kinds), random))
    yield from islice((each for each in islice(tried, size * _TRIES) if each is not None), size)


def _tried(path: Path, root: XmlElement, spot: Spot, random: Random, paths: Iterable[Path]) -> Mutant | None:
    """The first change that readers accept; None where there is none."""
    old, whole = spot.value, text_of(root)
    for new in others(spot, random):
        spot.write(new)
        changed = text_of(root)
        spot.write(old)
        try:
            found = diff(whole, changed, paths=paths)
        except CompileError:
            continue
        verdict = str(found.items[0].severity) if found.items else why_not_compared(spot) or MISSED
        return Mutant(path, spot.path, old.strip(), new, verdict)
    return None


def shuffled(items: Sequence[str], random: Random) -> list[str]:
    """The items in another order."""
    return random.sample(items, len(items))


def tree_of(path: Path, paths: Iterable[Path]) -> XmlElement | None:
    """The tree of a file that can be compared, with all that it includes, as it is after repairs."""
    try:
        tree = read(path, LoadOptions()).tree
        if tree is not None:
            diff(text_of(tree), text_of(tree), paths=paths)
    except CompileError:
        return None
    return tree


def text_of(root: XmlElement) -> bytes:
    """The file again."""
    return etree.tostring(root, xml_declaration=True, encoding="utf-8")
