"""Corpus files with mistakes: which file, and which mistakes, is decided by a number."""

from dataclasses import dataclass
from functools import cache
from random import Random

from lxml import etree

from testbed.corpus.files import CorpusFile, Kind, models
from testbed.mutated.mutants import mutant
from testbed.mutated.slips import slipped
from twinform.schemas import XmlElement

_LARGEST = 6000
"""In bytes: a judge needs longer for a file the longer it is, and small files have the same mistakes."""
_NEWER = frozenset({"1.10", "1.11", "1.12"})
"""Versions of SDF that libsdformat 12 does not read."""


@dataclass(frozen=True, slots=True)
class Mutated:
    """A document, and how it is made again."""

    kind: Kind
    seed: int
    file: str
    text: bytes

    def __str__(self) -> str:
        return f"{self.kind} {self.seed} ({self.file})"


@cache
def sources(kind: Kind) -> tuple[CorpusFile, ...]:
    """The files of a kind that are small, well-formed, include no other, and are of a version that the judges read."""
    return tuple(file for file in models() if file.kind is kind and _is_source(file))


def mutated(kind: Kind, seed: int) -> Mutated:
    """One document in two has one slip, one in four two, and one in four up to four blind changes."""
    random = Random(seed)
    file = random.choice(sources(kind))
    return mistaken(kind, seed, random, file.name, _root(file))


def mistaken(kind: Kind, seed: int, random: Random, file: str, root: XmlElement) -> Mutated:
    """The document of a number, made of a file."""
    made = mutant(root, random) if seed % 4 == 3 else slipped(root, random, 1 + seed % 4 // 2)
    return Mutated(kind, seed, file, etree.tostring(made))


def _is_source(file: CorpusFile) -> bool:
    row = file.row
    if file.path.stat().st_size > _LARGEST or row.get("well_formed", "yes") != "yes" or row.get("uses_include"):
        return False
    root = _parsed(file)
    return root is not None and root.get("version") not in _NEWER and root.find(".//include") is None


@cache
def _root(file: CorpusFile) -> XmlElement:
    root = _parsed(file)
    assert root is not None
    return root


def _parsed(file: CorpusFile) -> XmlElement | None:
    try:
        return etree.parse(file.path).getroot()
    except etree.XMLSyntaxError:
        return None
