"""Conversion audit: counts what became of every element and attribute of a source, without the converter's code.

It reads two trees and the ledger, and nothing of how the one was made of the other. Each part of the source gets one
fate: that of the entry of the ledger that covers its place, if there is one; *carried* if its content stands in our
own namespace in the result; *expressed* if it stands elsewhere in the result, or is a number of those that a change of
frame recomputes (poses, axes and moments of inertia). What none of that holds for is *unaccounted*: a fault of ours.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from lxml import etree

from twinform.compiler.folded_chains import Folded
from twinform.diagnostics import Fate, Ledger, Location
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.schemas import XmlElement, path_of

_OURS = f"{{{NAMESPACE}}}"
# Elements and attributes whose numbers depend on the frame that they are expressed in, so that no
# value can be expected.
_COMPUTED = frozenset({"pose", "origin", "xyz", "rpy", "axis", "inertia", "ixx", "ixy", "ixz", "iyy", "iyz", "izz"})
_SHAPE_NAME = re.compile(r"(.+)_(?:visual|collision)(?:_\d+)?")
_MATERIAL = re.compile(r"(.+)_material(?:_\d+)?")
_SCHEME = re.compile(r"\b[a-z]+://")
# Elements of one format that imply a word of the other: a frame stands for a fixed joint.
_IMPLIED_BY = {"frame": "fixed"}
# Booleans that the other format writes as their opposites.
_OPPOSITES = {"turnGravityOff": {"0.0": "1.0", "1.0": "0.0"}}
_SYNONYMS = {"revolute": "continuous", "continuous": "revolute"}
"""Words that may be another one in the other format: a joint that turns without an end."""
_TRUTHS = {"true": "1.0", "yes": "1.0", "false": "0.0", "no": "0.0"}
_PREDICATE = re.compile(r"\[[^]]*+\]?|\{[^}]*+\}?|(?<=[/@])[\w.-]+:")
_Place = tuple[int, str]
"""A line of the source, and the path of an element or attribute that begins there."""
_PUNCTUATION = str.maketrans(dict.fromkeys("/:,;", " "))


class UnaccountedPart(NamedTuple):
    """An element or attribute of the source that nothing accounts for."""

    location: Location
    text: str


@dataclass(frozen=True, slots=True)
class Audit:
    """How many elements and attributes met each fate; together they are the whole source."""

    expressed: int
    carried: int
    approximated: int
    dropped: int
    unaccounted: tuple[UnaccountedPart, ...]

    @property
    def total(self) -> int:
        """All elements and attributes of the source."""
        return self.expressed + self.carried + self.approximated + self.dropped + len(self.unaccounted)


class Met(NamedTuple):
    """An element, or one attribute of it, and what became of it; no fate where it is expressed or unaccounted.

    `missing` are the words that nothing accounts for.
    """

    element: XmlElement
    attribute: str | None
    fate: Fate | None
    missing: tuple[str, ...] = ()


def audit(source: XmlElement, result: str, ledger: Ledger) -> Audit:
    """Count the fates of all parts of `source` in the XML of `result`."""
    count = dict.fromkeys(("expressed", *Fate), 0)
    unaccounted: list[UnaccountedPart] = []
    for met in fates(source, result, ledger):
        if met.missing:
            path = path_of(met.element)
            path = f"{path}/@{met.attribute}" if met.attribute else path
            unaccounted.append(
                UnaccountedPart(Location(line=met.element.sourceline or 0, path=path), ", ".join(met.missing))
            )
        else:
            count[met.fate or "expressed"] += 1
    carried, approximated, dropped = (count[fate] for fate in Fate)
    return Audit(count["expressed"], carried, approximated, dropped, tuple(unaccounted))


def fates(source: XmlElement, result: str, ledger: Ledger) -> Iterator[Met]:
    """What became of each element and attribute of `source`, from the outside in."""
    made = etree.fromstring(result.encode())
    inside, outside = _words_of(made)
    folded = Folded.of(source, made)
    outside |= folded.parts
    listed, noted = _places(ledger, counted=True), _places(ledger, counted=False)
    for part, note in zip(_parts(source, listed), _parts(source, noted), strict=True):
        if part.fate is not None:
            yield Met(part.element, part.attribute, part.fate)
        elif (
            part.computed
            or folded.expresses(part.element, part.attribute)
            or all(word in outside or _implied(word, outside) for word in part.words)
        ):
            yield Met(part.element, part.attribute, None)
        elif part.words <= inside | outside:
            yield Met(part.element, part.attribute, Fate.CARRIED)
        elif note.fate is not None:
            yield Met(part.element, part.attribute, note.fate)
        else:
            yield Met(part.element, part.attribute, None, tuple(sorted(part.words - inside - outside)))


def _places(ledger: Ledger, *, counted: bool) -> dict[_Place, Fate]:
    """The fates by the places of entries; one that counts no part is about its place only where nothing has that."""
    entries = (entry for entry in reversed(ledger.entries) if bool(entry.weight) is counted)
    return {(entry.location.line, bare_path(entry.location.path)): entry.fate for entry in entries}


@dataclass(frozen=True, slots=True)
class _Piece:
    """An element or attribute of the source: the words in it, and the fate that the ledger has for its place."""

    element: XmlElement
    attribute: str | None
    words: frozenset[str]
    fate: Fate | None

    @property
    def computed(self) -> bool:
        if self.attribute == "version" and self.element.getparent() is None:
            return True  # it is about the format of the file, and the result has its own
        return str(self.element.tag) in _COMPUTED and all(map(_is_number, self.words))


def _parts(root: XmlElement, fates: dict[_Place, Fate]) -> Iterator[_Piece]:
    """All elements and attributes, from the outside in; what covers an element covers all that is in it.

    An entry may say the line of the element or of one around it, where the converter knows no better.
    """
    stack: list[tuple[XmlElement, Fate | None, str, tuple[int, ...]]] = [(root, None, "", ())]
    while stack:
        element, above, around, lines = stack.pop()
        ours = str(element.tag).startswith(_OURS)  # which means something to us alone, but for what is in it
        if ours and not len(element):
            continue
        path, lines = f"{around}/{_local(str(element.tag))}", (element.sourceline or 0, *lines)
        fate = above or _fate_at(path, lines, fates)
        stack += [(child, fate, path, lines) for child in reversed(element) if isinstance(child.tag, str)]
        if ours:
            continue
        opposite = _OPPOSITES.get(_local(str(element.tag)), {})
        words = frozenset(opposite.get(word, word) for word in _words(element.text or ""))
        yield _Piece(element, None, words, fate or (_fate_at(f"{path}/text()", lines, fates) if words else None))
        for name, value in element.items():
            if str(name).startswith(_OURS):
                continue
            own = _fate_at(f"{path}/@{_local(str(name))}", lines, fates)
            yield _Piece(element, str(name), frozenset(_words(str(value))), fate or own)


def _fate_at(path: str, lines: tuple[int, ...], fates: dict[_Place, Fate]) -> Fate | None:
    return next((fate for line in lines if (fate := fates.get((line, path)))), None)


def bare_path(path: str) -> str:
    """A path without what tells one element from its like; the line of the part does that."""
    return _PREDICATE.sub("", path)


def _local(name: str) -> str:
    return name.rpartition("}")[2]


def _words_of(result: XmlElement) -> tuple[frozenset[str], frozenset[str]]:
    """The values of the result in our own namespace, and those outside of it."""
    inside: set[str] = set()
    outside: set[str] = set()
    stack = [(result, outside)]
    while stack:
        element, words = stack.pop()
        words = inside if str(element.tag).startswith(_OURS) else words
        written = frozenset(_words(element.text or ""))
        opposites = _OPPOSITES.get(_local(str(element.tag)), {})
        words.update(written, (opposites[word] for word in written if word in opposites))
        if (implied := _IMPLIED_BY.get(str(element.tag))) is not None:
            words.add(implied)
        for name, value in element.items():
            (inside if str(name).startswith(_OURS) else words).update(_words(str(value)))
        stack += [(child, words) for child in element if isinstance(child.tag, str)]
    return frozenset(inside), frozenset(outside)


def _words(text: str) -> Iterable[str]:
    """The words of a text, numbers in one spelling, paths and scoped names in their pieces.

    The scheme of a URI does not count: both formats have their own for the same folder.
    """
    return map(_spelt, _SCHEME.sub("", text).translate(_PUNCTUATION).split())


def _spelt(word: str) -> str:
    if word.lower() in _TRUTHS:
        return _TRUTHS[word.lower()]
    try:
        return repr(float(word) + 0.0)
    except ValueError:
        return word


def _implied(word: str, words: frozenset[str]) -> bool:
    """Whether another word stands for it, or it is the name synthesized for a shape of a link, or for its material."""
    if _SYNONYMS.get(word) in words:
        return True
    name = _SHAPE_NAME.fullmatch(word)
    return (name is not None and name[1] in words) or _is_synthesized_material(word, words)


def _is_synthesized_material(word: str, words: frozenset[str]) -> bool:
    """Whether it is LINK_VISUAL_material of a link and a visual that are there."""
    made = _MATERIAL.fullmatch(word)
    pairs = re.finditer("_", made[1]) if made else ()
    return any({pair.string[: pair.start()], pair.string[pair.end() :]} <= words for pair in pairs)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
