"""Conversion audit: counts what became of every element and attribute of a source, without the converter's code.

It only reads the two trees and the ledger. Each part of the source gets one fate: the fate of the ledger entry for its
place, if there is one; *expressed* if its content is in the result, or if it is a number that a change of frame
recomputes (poses, axes and moments of inertia); *carried* if its content is in our own namespace in the result.
Anything else is *unaccounted*, which is a bug in the converter.
"""

import re
from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple, Self

from lxml import etree

from twinform.compiler.audit_mjcf import COMPUTED, KINDS, carried_in_mjcf, implied_in_mjcf, name_in_sdf
from twinform.compiler.settle_ledger import bare_path
from twinform.dataclass import dataclass
from twinform.diagnostics import Fate, Ledger, Location
from twinform.ir.defaults import UNLIMITED
from twinform.ir.frames import MODEL
from twinform.lazy import lazy_pattern
from twinform.passes.carriers.annotations import MIMIC, SYNTHESIZED
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.joint_chains import CHAIN, PART
from twinform.passes.carriers.old_names import NAME
from twinform.passes.carriers.token_mass import TOKEN_MASS, UNSAID
from twinform.passes.legalise.changed_names import SCOPED_NAME
from twinform.passes.legalise.world_link import OF_WORLD
from twinform.passes.shared.joint_ends import GEARED
from twinform.passes.shared.link_shapes import COMPUTED_MASS
from twinform.passes.shared.replaced_shapes import CAPSULE_END, SHAPE
from twinform.schemas import XmlElement, path_of
from twinform.schemas.value_types import format_number

_OURS = f"{{{NAMESPACE}}}"
# Elements and attributes whose numbers depend on the frame that they are expressed in, so that no
# value can be expected.
_COMPUTED = frozenset(
    {"pose", "origin", "xyz", "rpy", "axis", "inertia", "ixx", "ixy", "ixz", "iyy", "iyz", "izz", "patch_radius"}
)
_SHAPE_NAME = lazy_pattern(r"(.+)_(?:visual|collision)(?:_\d+)?")
_MATERIAL = lazy_pattern(r"(.+)_material(?:_\d+)?")
_SCHEME = lazy_pattern(r"\b[a-z]+://")
# Elements of one format that imply a word of the other: a frame stands for a fixed joint.
_IMPLIED_BY = {"frame": "fixed"}
# Booleans that the other format writes as their opposites.
_OPPOSITES = {"turnGravityOff": {"0.0": "1.0", "1.0": "0.0"}}
_SYNONYMS = {"revolute": "continuous", "continuous": "revolute", "ball": "spherical", "hfield": "heightmap"}
"""Words for which the other format may have another one: a continuous joint may be a revolute one without limits."""
_TRUTHS = {"true": "1.0", "yes": "1.0", "false": "0.0", "no": "0.0"}
_Place = tuple[int, str]
"""A line of the source, and the path of an element or attribute that begins on it."""
_PUNCTUATION = str.maketrans(dict.fromkeys("/:,;", " "))


class UnaccountedPart(NamedTuple):
    """An element or attribute of the source that nothing accounts for."""

    location: Location
    text: str


@dataclass(frozen=True, slots=True)
class Audit:
    """The number of elements and attributes of each fate; together they are the whole source."""

    expressed: int
    carried: int
    approximated: int
    dropped: int
    unaccounted: tuple[UnaccountedPart, ...]

    @property
    def total(self) -> int:
        """All elements and attributes of the source."""
        return self.expressed + self.carried + self.approximated + self.dropped + len(self.unaccounted)


class PartFate(NamedTuple):
    """An element or attribute and its fate, which is None where it is expressed or unaccounted.

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


def fates(source: XmlElement, result: str, ledger: Ledger) -> Iterator[PartFate]:
    """Yield the fate of each element and attribute of `source`, outer elements first."""
    made = etree.fromstring(result.encode())
    inside, outside = _words_of(made)
    folded = Folded.of(source, made)
    outside |= folded.parts
    if source.tag == "mujoco":  # in which a word says what an element is in the others
        outside |= frozenset(_local(str(each.tag)) for each in made.iter("*"))
    listed, noted = _places(ledger, counted=True), _places(ledger, counted=False)
    for part, note in zip(_parts(source, listed), _parts(source, noted), strict=True):
        if part.fate is not None:
            yield PartFate(part.element, part.attribute, part.fate)
        elif (
            part.computed
            or folded.expresses(part.element, part.attribute)
            or all(word in outside or _is_implied(word, outside) for word in part.words)
        ):
            yield PartFate(part.element, part.attribute, None)
        elif part.words <= inside | outside:
            yield PartFate(part.element, part.attribute, Fate.CARRIED)
        elif note.fate is not None:
            yield PartFate(part.element, part.attribute, note.fate)
        else:
            yield PartFate(part.element, part.attribute, None, tuple(sorted(part.words - inside - outside)))


def _places(ledger: Ledger, *, counted: bool) -> dict[_Place, Fate]:
    """Return the fates of the ledger's entries by place: either of those that count parts, or of the other ones."""
    entries = (entry for entry in reversed(ledger.entries) if bool(entry.weight) is counted)
    return {(entry.location.line, bare_path(entry.location.path)): entry.fate for entry in entries}


@dataclass(frozen=True, slots=True)
class _Piece:
    """An element or attribute of the source with its words, and the fate that the ledger has for its place."""

    element: XmlElement
    attribute: str | None
    words: frozenset[str]
    fate: Fate | None
    of_mjcf: bool = False

    @property
    def computed(self) -> bool:
        if self.attribute == "version" and self.element.getparent() is None:
            return True  # it is about the format of the file, and the result has its own
        is_computed = self.attribute in COMPUTED if self.of_mjcf else str(self.element.tag) in _COMPUTED
        return is_computed and all(map(_is_number, self.words))


def _parts(root: XmlElement, fates: dict[_Place, Fate]) -> Iterator[_Piece]:
    """Yield all elements and attributes, outer elements first; the fate of an element is also that of its content.

    An entry may have the line of the element or of one around it, where the converter does not know better.
    """
    stack: list[tuple[XmlElement, Fate | None, str, tuple[int, ...]]] = [(root, None, "", ())]
    of_mjcf = root.tag == "mujoco"
    while stack:
        element, above, around, lines = stack.pop()
        ours = str(element.tag).startswith(_OURS)  # which means something to us alone, but for what is in it
        if (ours and not len(element)) or carried_in_mjcf(element) is not None:
            continue
        path, lines = f"{around}/{_local(str(element.tag))}", (element.sourceline or 0, *lines)
        fate = above or _fate_at(path, lines, fates)
        stack += [(child, fate, path, lines) for child in reversed(element) if isinstance(child.tag, str)]
        if ours:
            continue
        opposite = _OPPOSITES.get(_local(str(element.tag)), {})
        words = frozenset(opposite.get(word, word) for word in _words(element.text or ""))
        own = _fate_at(f"{path}/text()", lines, fates) if words else None
        yield _Piece(element, None, words, fate or own, of_mjcf)
        for name, value in element.items():
            if str(name).startswith(_OURS):
                continue
            word = name_in_sdf(element, _local(str(name))) if of_mjcf else _local(str(name))
            own = _fate_at(f"{path}/@{word}", lines, fates)
            yield _Piece(element, str(name), frozenset(_words(str(value))), fate or own, of_mjcf)


def _fate_at(path: str, lines: tuple[int, ...], fates: dict[_Place, Fate]) -> Fate | None:
    return next((fate for line in lines if (fate := fates.get((line, path)))), None)


def _local(name: str) -> str:
    return name.rpartition("}")[2]


def _words_of(result: XmlElement) -> tuple[frozenset[str], frozenset[str]]:
    """Return the words of the result in our own namespace, and those outside of it."""
    inside: set[str] = set()
    outside: set[str] = set()
    stack = [(result, outside)]
    while stack:
        element, words = stack.pop()
        if (carried := carried_in_mjcf(element)) is not None:
            stack.append((carried, inside))
            continue
        words = inside if str(element.tag).startswith(_OURS) else words
        words.update(implied_in_mjcf(element))
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
    """Split a text into words, with numbers in one spelling, and paths and scoped names in pieces.

    The scheme of a URI does not count: each format has its own for the same folder.
    """
    return map(_spelt, _SCHEME.sub("", text).translate(_PUNCTUATION).split())


def _spelt(word: str) -> str:
    if word.lower() in _TRUTHS:
        return _TRUTHS[word.lower()]
    try:
        return repr(float(word) + 0.0)
    except ValueError:
        return word


def _is_implied(word: str, words: frozenset[str]) -> bool:
    """Whether a word has a synonym in the result, or is a name that was synthesized for a shape or its material."""
    if _SYNONYMS.get(word) in words or not words.isdisjoint(KINDS.get(word, ())):
        return True
    name = _SHAPE_NAME.fullmatch(word)
    return (name is not None and name[1] in words) or _is_synthesized_material(word, words)


def _is_synthesized_material(word: str, words: frozenset[str]) -> bool:
    """Whether a word is LINK_VISUAL_material, for a link and a visual in the result."""
    made = _MATERIAL.fullmatch(word)
    pairs = re.finditer("_", made[1]) if made else ()
    return any({pair.string[: pair.start()], pair.string[pair.end() :]} <= words for pair in pairs)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


_CHAIN, _PART, _MADE, _GEARED, _URDF = (f"{_OURS}{word}" for word in (CHAIN, PART, SYNTHESIZED, GEARED, "urdf"))
_END, _SHAPE = f"{_OURS}{CAPSULE_END}", f"{_OURS}{SHAPE}"
_OLD_NAMES = tuple(f"{_OURS}{word}" for word in (NAME, SCOPED_NAME, OF_WORLD))
_UNSAID = f"{_OURS}{UNSAID}"
_MIMIC = f"{_OURS}{MIMIC}"
_COMPUTED_MASS = f"{_OURS}{COMPUTED_MASS}"
# The mass in SDF of a link that has none in URDF.
_TOKEN_MASS = format_number(TOKEN_MASS)
_NAMED = ("link", "joint", "frame", "model", "visual", "collision")


@dataclass(frozen=True, slots=True)
class Folded:
    """What a reverse conversion writes differently, because annotations tell what a part was made from.

    `there` has the tag, name and type of each part of the result, and `named` its tag and name. `parts` are the names
    of parts that are gone from it, `followers` its joints with a mimic, and `ends` the joints that chains became.
    `shapes` has the tag and name of each visual and collision with each element of its geometry. `in_mjcf` tells
    whether the result is MJCF, which writes no limit that means none.
    """

    there: frozenset[tuple[str, str, str]] = frozenset()
    named: frozenset[tuple[str, str]] = frozenset()
    parts: frozenset[str] = frozenset()
    followers: frozenset[str] = frozenset()
    ends: frozenset[str] = frozenset()
    shapes: frozenset[tuple[str, str, str]] = frozenset()
    in_mjcf: bool = False

    @classmethod
    def of(cls, source: XmlElement, result: XmlElement) -> Self:
        """Find the differences that arise because `result` folds chains of joints in `source` back into one joint."""
        found = [each for tag in _NAMED for each in result.iter(f"{{*}}{tag}")]  # <drake:joint> too
        there = frozenset((etree.QName(each).localname, each.get("name", ""), each.get("type", "")) for each in found)
        named = frozenset((tag, name) for tag, name, _ in there)
        followers = frozenset(each.get("name", "") for each in found if next(each.iter("mimic"), None) is not None)
        chains = ((annotation.getparent(), annotation.get("type", "")) for annotation in source.iter(_CHAIN))
        ends = frozenset(
            name for end, kind in chains if end is not None and ("joint", name := end.get("name", ""), kind) in there
        )
        folded = cls(there, named, frozenset(), followers, ends)
        annotations = [annotation.getparent() for word in (_PART, _MADE, _END) for annotation in source.iter(word)]
        gone = {each.get("name", "") for each in annotations if each is not None and folded.is_gone(each)}
        gone |= set(_synthesized_names(source, result, named))
        shapes = frozenset(
            (str(each.tag), each.get("name", ""), str(shape.tag))
            for each in found
            for shape in each.iterfind("geometry/*")
        )
        return cls(there, named, frozenset(gone), followers, ends, shapes, in_mjcf=result.tag == "mujoco")

    def expresses(self, element: XmlElement, attribute: str | None) -> bool:
        """Whether the result expresses a part of the source in another way, such as by one joint for several."""
        if attribute == "type" and element.tag == "joint":
            return self._is_end(element)
        if _is_synthesized_number(element, attribute) or any(map(self.is_gone, (element, *element.iterancestors()))):
            return True
        holder = element.getparent()
        if self.in_mjcf and element.tag in {"lower", "upper"} and holder is not None and holder.tag == "limit":
            return _is_no_limit(element.text or "")
        if element.tag in {"mesh", "uri"} and self._is_folded_mesh(element):
            return True
        return element.tag == "mimic" and holder is not None and self._is_geared(holder)

    def is_gone(self, element: XmlElement) -> bool:
        """Whether an element was synthesized by a conversion and left out by the reverse one."""
        if (str(element.tag), element.get("name", "")) in self.named:
            return False
        part = element.find(_PART)
        return (
            (element.find(_MADE) is not None or element.find(_END) is not None)
            if part is None
            else part.get("joint", "") in self.ends
        )

    def _is_folded_mesh(self, element: XmlElement) -> bool:
        """Whether the result has the shape that a mesh stood for."""
        part = next(element.iterancestors("visual", "collision"), None)
        stood_for = part.iterfind(f"{_SHAPE}/geometry/*") if part is not None else ()
        return part is not None and any(
            (str(part.tag), part.get("name", ""), str(shape.tag)) in self.shapes for shape in stood_for
        )

    def _is_end(self, joint: XmlElement) -> bool:
        """Whether a joint has the type in the result that its annotation names."""
        kinds = [annotation.get("type") for annotation in joint.findall(_CHAIN)]
        kinds += [
            annotation.get("value") for annotation in joint.findall(_URDF) if annotation.get("attribute") == "type"
        ]
        if not kinds:
            return any(map(self.is_gone, (joint, *joint.iterancestors())))
        return any(("joint", joint.get("name", ""), kind) in self.there for kind in kinds)

    def _is_geared(self, joint: XmlElement) -> bool:
        """Whether a joint mimicked because of a gearbox, and the result has the gearbox instead."""
        has_gearbox = any(kind == "gearbox" for _, _, kind in self.there)
        return joint.find(_GEARED) is not None and has_gearbox and joint.get("name", "") not in self.followers


def _synthesized_names(source: XmlElement, result: XmlElement, named: Collection[tuple[str, str]]) -> Iterator[str]:
    """Yield the names that a conversion gave to parts that have their old names again."""
    roots = {(str(result.tag), result.get("name", ""))}
    for annotation in (each for word in _OLD_NAMES for each in source.iter(word)):
        holder, old = annotation.getparent(), annotation.get("was") or (annotation.text or "").strip()
        tag = "" if holder is None else "robot" if holder.tag == "model" else str(holder.tag)
        if (tag, old) in roots or _is_there(tag, old, named):
            yield annotation.get("instead_of", "")


def _is_there(tag: str, old: str, named: Collection[tuple[str, str]]) -> bool:
    """Whether an old name is in the result; a link of URDF may have stood for a frame or a model."""
    inner = old.removesuffix(f"::{MODEL}").rpartition("::")[2]
    return any((kind, name) in named for kind in (tag, "frame", "model") for name in (old, inner))


def _is_synthesized_number(element: XmlElement, attribute: str | None) -> bool:
    """Whether a number was synthesized: a computed or token mass, the offset of a mimic, or a limit that means none."""
    holder = element.getparent()
    if holder is None:
        return False
    if element.tag == "mass":
        is_token = holder.find(_UNSAID) is not None and (element.text or "").strip() == _TOKEN_MASS
        return is_token or holder.find(_COMPUTED_MASS) is not None
    if element.tag == "mimic":
        return attribute == "offset" and holder.find(_MIMIC) is not None
    return element.tag == "limit" and attribute is not None and _is_no_limit(element.get(attribute, ""))


def _is_no_limit(number: str) -> bool:
    """Whether a limit is so large that it means none, which neither SDF nor MJCF need write."""
    try:
        return abs(float(number)) >= UNLIMITED
    except ValueError:
        return False
