"""Other spellings of what a file says: what a comparison must not notice."""

import math
from collections.abc import Callable, Iterable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from random import Random

from lxml import etree

from testbed.value_mutants import Described, Spot, described, is_number, spots, text_of, tree_of
from twinform.compiler import CompileError
from twinform.compiler.compare import diff
from twinform.compiler.input.front_ends import declared_version
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Pose
from twinform.ir.transform import Transform
from twinform.schemas import Fact, XmlElement

_FIRST_WITH_QUATERNIONS = (1, 9)
_NUMBERS = frozenset({"double", "vector3", "pose", "color", "vector2d"})

Respell = Callable[[XmlElement, Random], str]
"""Changes a tree in place, and gives the place where it did; nothing where it could not."""


@dataclass(frozen=True, slots=True)
class Respelling:
    """A file in another spelling; `found` is what the comparison says of it, which should be nothing."""

    path: Path
    kind: str
    place: str
    found: str

    @property
    def name(self) -> str:
        """Which one it is."""
        return f"{self.path.name}: {self.kind}: {self.place}: {self.found}"


def respellings(path: Path, size: int, seed: int, paths: Iterable[Path] = ()) -> Iterator[Respelling]:
    """A file in so many of the other spellings that it can have, each compared with the file."""
    root = tree_of(path, paths)
    if root is not None:
        random = Random(f"{path.name}{seed}")
        made = (_respelled(path, root, kind, random, paths) for kind in random.sample(sorted(KINDS), len(KINDS)))
        yield from islice((each for each in made if each is not None), size)


def _respelled(path: Path, root: XmlElement, kind: str, random: Random, paths: Iterable[Path]) -> Respelling | None:
    changed = deepcopy(root)
    place = KINDS[kind](changed, random)
    if not place:
        return None
    try:
        items = diff(text_of(root), text_of(changed), paths=paths).items
    except CompileError:
        return None  # readers take one spelling alone there
    return Respelling(path, kind, place, items[0].message if items else "")


def _chosen(found: Iterable[Spot], random: Random) -> Spot | None:
    among = list(found)
    return random.choice(among) if among else None


def _is_numeric(spot: Spot) -> bool:
    words = spot.value.split()
    return spot.row is not None and spot.row.type in _NUMBERS and bool(words) and all(map(is_number, words))


def _numbers(root: XmlElement, random: Random) -> str:
    spot = _chosen((each for each in spots(root) if _is_numeric(each)), random)
    if spot is None:
        return ""
    spot.write(" ".join(random.choice((f"{float(word)!r}", f"{float(word):.17e}")) for word in spot.value.split()))
    return spot.path


def _blanks(root: XmlElement, random: Random) -> str:
    spot = _chosen((each for each in spots(root) if _is_numeric(each)), random)
    if spot is None:
        return ""
    spot.write(f" {'  '.join(spot.value.split())} ")
    return spot.path


def _flags(root: XmlElement, random: Random) -> str:
    words = {"true": "1", "false": "0", "1": "true", "0": "false"}
    among = (each for each in spots(root) if each.row and each.row.type == "bool" and each.value.strip() in words)
    spot = _chosen(among, random)
    if spot is None:
        return ""
    spot.write(words[spot.value.strip()])
    return spot.path


def _attributes(root: XmlElement, _: Random) -> str:
    for element in root.iter("*"):
        items = list(reversed(element.items()))
        element.attrib.clear()
        element.attrib.update(items)
    return "everywhere"


def _comments(root: XmlElement, random: Random) -> str:
    element = random.choice([each for each in root.iter("*") if len(each)] or [root])
    element.insert(random.randint(0, len(element)), etree.Comment(" a comment "))
    return str(element.tag)


def _poses(root: XmlElement, random: Random, *, degrees: bool) -> str:
    if root.tag != "sdf" or declared_version(root, "sdf", DiagnosticSink()) < _FIRST_WITH_QUATERNIONS:
        return ""
    among = (
        each for each in spots(root) if each.row and each.row.type == "pose" and not each.name and _is_numeric(each)
    )
    spot = _chosen((each for each in among if {*each.element.keys()} <= {"relative_to"}), random)
    if spot is None:
        return ""
    numbers = tuple(map(float, spot.value.split()))
    if degrees:
        spot.element.set("degrees", "true")
        spot.write(" ".join(map(repr, (*numbers[:3], *map(math.degrees, numbers[3:])))))
    else:
        turned = Transform.from_pose(Pose.model_validate({"xyz": numbers[:3], "rpy": numbers[3:]})).quaternion()
        spot.element.set("rotation_format", "quat_xyzw")
        spot.write(" ".join(map(repr, (*numbers[:3], *turned))))
    return spot.path


def _defaults(root: XmlElement, random: Random) -> str:
    """Write a default that is not written."""
    if root.tag != "sdf":
        return ""
    among = [(each.element, name, row) for each in described(root) for name, row in _left_out(each)]
    if not among:
        return ""
    element, name, row = random.choice(among)
    made = etree.SubElement(element, name)
    made.text = row.default
    return f"{element.tag}/{name}"


def _left_out(each: Described) -> Iterator[tuple[str, Fact]]:
    """The elements with a default that could stand in another one, and do not."""
    for name, row in each.rows.items():
        is_leaf = row.type in {*_NUMBERS, "bool"} and not row.is_attribute and row.count == "?"
        if is_leaf and row.default and row.dialect is None and each.element.find(name) is None:
            yield name, row


KINDS: dict[str, Respell] = {
    "numbers": _numbers,
    "blanks": _blanks,
    "flags": _flags,
    "order of attributes": _attributes,
    "comments": _comments,
    "quaternions": lambda root, random: _poses(root, random, degrees=False),
    "degrees": lambda root, random: _poses(root, random, degrees=True),
    "defaults": _defaults,
}
