"""Settles a ledger about MJCF: each element and attribute of the file counts once, with its worst fate.

A shape of MJCF becomes a collision and a visual, what only MJCF says is carried before somebody leaves out what carries
it, and passes count the elements that they see, which are those of SDF. So entries about one place may count more than
the place has.
"""

from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import islice

from twinform.compiler.audit_mjcf import name_in_sdf
from twinform.diagnostics import Fate, LedgerEntry
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement

_WORST_FIRST = (Fate.DROPPED, Fate.CARRIED, Fate.APPROXIMATED)
_PREDICATE = lazy_pattern(r"\[[^]]*+\]?|\{[^}]*+\}?")
_PREFIX = lazy_pattern(r"(?<=[/@])[\w.-]+:")
_Part = tuple[XmlElement, str]
"""An element, and the name of one of its attributes, or nothing for the element itself."""
_Place = tuple[int, str, str]
"""A line, a path without names, and the name of an attribute or nothing."""


def settle(entries: Sequence[LedgerEntry], root: XmlElement) -> tuple[LedgerEntry, ...]:
    """Return the entries in their order, with weights that together count each part of the tree at most once."""
    elements = _elements_by_place(root, {entry.location.line for entry in entries})
    taken: set[_Part] = set()
    # What is taken stays so: the next entry about a place goes on where the one before it stopped. All the elements
    # of a file on one line are at few places.
    parts: dict[_Place, Iterator[_Part]] = {}
    weights = [entry.weight for entry in entries]
    for number in sorted(range(len(entries)), key=lambda number: _WORST_FIRST.index(entries[number].fate)):
        entry = entries[number]
        place = _place_of(entry)
        if place not in parts:
            parts[place] = _parts_of(place, elements)
        mine = [*islice((part for part in parts[place] if part not in taken), entry.weight)]
        taken.update(mine)
        weights[number] = len(mine)
    return tuple(
        entry if entry.weight == weight else replace(entry, weight=weight)
        for entry, weight in zip(entries, weights, strict=True)
    )


@lru_cache(maxsize=1024)  # most are names of elements and attributes, and paths that stand together are alike
def bare_path(path: str) -> str:
    """Return a path without predicates and prefixes; the line of a part tells elements of one path apart."""
    bare = _PREDICATE.sub("", path)
    return _PREFIX.sub("", bare) if ":" in bare else bare  # few have one, and each step would be looked at


def _elements_by_place(root: XmlElement, lines: Collection[int]) -> dict[tuple[int, str], list[XmlElement]]:
    """Return the elements in some lines of a tree, by their lines and paths without names."""
    found: dict[tuple[int, str], list[XmlElement]] = defaultdict(list)
    stack = [(root, f"/{root.tag}")]
    while stack:
        element, path = stack.pop()
        line = element.sourceline or 0
        if line in lines:
            found[line, path].append(element)
        stack += [(child, f"{path}/{bare_path(child.tag)}") for child in element if isinstance(child.tag, str)]
    return found


def _place_of(entry: LedgerEntry) -> _Place:
    line, path = entry.location.line, entry.location.path
    before, at, attribute = path.rpartition("/@")
    if at and attribute.isidentifier():  # most are plain, and entries about one element have one path before it
        return line, bare_path(before), attribute
    path, _, attribute = bare_path(path).partition("/@")
    return line, path, attribute


def _parts_of(place: _Place, elements: dict[tuple[int, str], list[XmlElement]]) -> Iterator[_Part]:
    """Yield the parts that an entry about a place may be about: those of its element, and then of what is in it."""
    line, path, attribute = place
    found = elements.get((line, path), ())
    if attribute:
        for each in found:
            is_root = each.getparent() is None
            for name in each.keys():  # noqa: SIM118 - see `_own_parts`
                # to compare the ends is much quicker, and few names have a prefix
                if (is_root or name.endswith(attribute)) and bare_path(name_in_sdf(each, str(name))) == attribute:
                    yield each, str(name)
        return
    for each in found:
        yield from _own_parts(each)
    for each in found:
        # the shapes of the world itself are an entry, and the bodies in it are none of them
        inside = (child for child in each if each.tag != "worldbody" or child.tag != "body")
        yield from (part for child in inside for below in child.iter("*") for part in _own_parts(below))


def _own_parts(element: XmlElement) -> Iterator[_Part]:
    yield element, ""
    for name in element.keys():  # noqa: SIM118 - an element of lxml is no dictionary
        yield element, str(name)
