"""Files of MJCF with mistakes: those of the tests, and of the packages that `make mjcf` fetches, if they are here."""

from functools import cache
from pathlib import Path
from random import Random

from lxml import etree

from testbed.corpus.files import ROOT, Kind
from testbed.mutated.mutated import Mutated, mistaken
from twinform.schemas import XmlElement

_LARGEST = 6000
_NAMING_FILES = (b"<include", b"file", b"<attach", b"<plugin", b"<composite")
"""What a copy in another folder would not find, or MuJoCo has no more."""


@cache
def mjcf_sources(*, fetched: bool = True) -> tuple[Path, ...]:
    """The files that are small and well-formed, and name no others; `fetched` ones are behind those of the tests."""
    own = sorted((ROOT / "tests" / "cases").rglob("*.xml"))
    others = sorted((ROOT / "out" / "mjcf" / "files").rglob("*.xml")) if fetched else []
    return tuple(path for path in (*own, *others) if _is_source(path))


def mutated_mjcf(seed: int, *, fetched: bool = True) -> Mutated:
    """The document of a number, with mistakes as in those of the corpus."""
    random = Random(seed)
    path = random.choice(mjcf_sources(fetched=fetched))
    return mistaken(Kind.MJCF, seed, random, path.relative_to(ROOT).as_posix(), _root(path))


def _is_source(path: Path) -> bool:
    text = path.read_bytes()
    if len(text) > _LARGEST or any(each in text for each in _NAMING_FILES):
        return False
    try:
        return etree.fromstring(text).tag == "mujoco"
    except etree.XMLSyntaxError:
        return False


@cache
def _root(path: Path) -> XmlElement:
    return etree.parse(path).getroot()
