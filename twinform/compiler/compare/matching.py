"""Which part of one robot is which of the other: by name, and shapes, whose names mean little, by what they are."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator

from twinform.compiler.compare.findings import Base, Findings, Subject, Terms
from twinform.compiler.compare.robot import Leaf, Leaves, Part
from twinform.compiler.compare.values import Place
from twinform.diagnostics import NOWHERE, Location

_BY_CONTENT = frozenset({"visual", "collision"})
"""Parts that converters rename, and that nothing but a name tells apart."""
_NOT_COMPARED_IN_CARRIERS = frozenset({"pose"})
"""A carried shape is posed in the frame that its link had in the other file."""

Pair = tuple[Part, Part]
Fits = Callable[[Part, Part, Terms, Base], bool]


def compare_leaves(
    findings: Findings,
    subject: Subject,
    a: Leaves,
    b: Leaves,
    base: Base,
    places: tuple[Location, Location] = (NOWHERE, NOWHERE),
    aspect: str = "",
    *,
    carried: bool = False,
) -> None:
    """Compare all values; below one that says of what kind a thing is, nothing is compared when the kinds differ."""
    closed: list[str] = []
    for path in sorted(a.keys() | b.keys()):
        if any(path.startswith(f"{above}/") for above in closed):
            continue
        if carried and path in _NOT_COMPARED_IN_CARRIERS:
            continue
        pair = (a.get(path), b.get(path))
        if _is_absent_pose(pair):
            continue
        name = f"{aspect}/{path}" if aspect else path
        if findings.leaf(subject, name, pair, base, places):
            closed.append(path)


def _is_absent_pose(pair: tuple[Leaf | None, Leaf | None]) -> bool:
    """Whether it is the place of something that one robot does not have, which its other values say."""
    one = pair[0] or pair[1]
    return None in pair and one is not None and isinstance(one.value, Place)


def compare_parts(findings: Findings, subject: Subject, a: Iterable[Part], b: Iterable[Part], base: Base) -> None:
    """Compare the parts of two links, joints or models."""
    groups_a, groups_b = _by_kind(a), _by_kind(b)
    for kind in sorted(groups_a.keys() | groups_b.keys()):
        pairs, only_a, only_b = match(groups_a.get(kind, []), groups_b.get(kind, []), findings.terms, base)
        for one, other in pairs:
            name = f"{kind} {one.name!r}"
            carried, places = one.carried or other.carried, (one.where, other.where)
            compare_leaves(findings, subject, one.leaves, other.leaves, base, places, name, carried=carried)
            _note_renamed(findings, subject, one, other)
        for in_a, rest in ((True, only_a), (False, only_b)):
            for part in rest:
                name = f"{kind} {part.name!r}"
                findings.lonely(subject, name, kind, part.where, in_a=in_a, only=part.only, carried=part.carried)


def _note_renamed(findings: Findings, subject: Subject, a: Part, b: Part) -> None:
    terms = findings.terms
    if a.name != b.name and terms.format_a is terms.format_b:
        message = f"{a.kind} {a.name!r} of {subject} is called {b.name!r} in {terms.b}"
        findings.note(subject, f"{a.kind} {a.name!r}/name", message, (a.where, b.where))


def _by_kind(parts: Iterable[Part]) -> dict[str, list[Part]]:
    found = defaultdict[str, list[Part]](list)
    for part in parts:
        found[part.kind].append(part)
    return found


def match(a: list[Part], b: list[Part], terms: Terms, base: Base) -> tuple[list[Pair], list[Part], list[Part]]:
    """Pairs of parts of one kind, and those of each robot that are left over."""
    pairs: list[Pair] = []
    left_a, left_b = list(a), list(b)
    for fits in _FITS if any(part.kind in _BY_CONTENT for part in (*a, *b)) else _FITS_BY_NAME:
        for one in list(left_a):
            found = next((other for other in left_b if fits(one, other, terms, base)), None)
            if found is not None:
                pairs.append((one, found))
                left_a = [each for each in left_a if each is not one]
                left_b = [each for each in left_b if each is not found]
    return pairs, left_a, left_b


def _has_name(a: Part, b: Part, _terms: Terms, _base: Base) -> bool:
    return a.name == b.name


def _has_shape(a: Part, b: Part, _terms: Terms, _base: Base) -> bool:
    return _shape(a) == _shape(b)


def _is_itself(a: Part, b: Part, terms: Terms, base: Base) -> bool:
    return a.name == b.name and is_same(a, b, terms, base)


def _shape(part: Part) -> object:
    leaf = part.leaves.get("geometry")
    return leaf.value if leaf else None


def is_same(a: Part, b: Part, terms: Terms, base: Base) -> bool:
    """Whether two parts say the same but for their names."""
    found = Findings(terms)
    subject = Subject("", "")
    compare_leaves(found, subject, a.leaves, b.leaves, base, carried=a.carried or b.carried)
    return not found.items


_FITS: tuple[Fits, ...] = (_is_itself, is_same, _has_name, _has_shape)
"""How shapes find each other, the surest way first."""
_FITS_BY_NAME: tuple[Fits, ...] = (_has_name,)


def unmatched(a: Iterable[Part], b: Iterable[Part], terms: Terms, base: Base) -> Iterator[Part]:
    """The parts for which the other robot has none that is the same."""
    groups_b = _by_kind(b)
    for kind, parts in _by_kind(a).items():
        pairs, only, _ = match(parts, groups_b.get(kind, []), terms, base)
        yield from only
        yield from (one for one, other in pairs if not is_same(one, other, terms, base))
