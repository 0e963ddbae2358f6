"""Matches the parts of two robots by name, and shapes, whose names mean little, by their geometry."""

from collections import defaultdict, deque
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sized
from dataclasses import replace
from functools import partial
from operator import attrgetter

from twinform.compiler.compare.compared_robot import Leaf, Leaves, LinkPart
from twinform.compiler.compare.compared_values import PoseValue, Text, show
from twinform.compiler.compare.comparison import UNKNOWN, Base, ComparedSubject, ComparisonFindings, Places, Terms
from twinform.ir.transform import Transform

_BY_CONTENT = frozenset({"visual", "collision"})
"""The kinds of parts that converters rename, and that are therefore matched by their content."""
_NOT_COMPARED_IN_CARRIERS = frozenset({"pose"})
"""A carried shape is posed in the frame that its link had in the other file."""

_WATCHED = "contact/collision"
# Links with 400 shapes in both files, all of them different, took 36 s when each was held against
# each. Of more, those that are equal to ten digits are paired by a table, and the rest by name and
# in their order.
_MOST_PAIRS = 100
"""With more pairs of shapes than this, they are not compared one by one."""

Pair = tuple[LinkPart, LinkPart]
Matched = tuple[list[Pair], list[LinkPart], list[LinkPart]]
"""Pairs of parts, and the parts of each robot that are left over."""
Fits = Callable[[LinkPart, LinkPart], bool]


def compare_leaves(
    findings: ComparisonFindings,
    subject: ComparedSubject,
    a: Leaves,
    b: Leaves,
    base: Base,
    places: Places = UNKNOWN,
    aspect: str = "",
    *,
    carried: bool = False,
) -> None:
    """Compare all values; below one that names the kind of a thing, nothing is compared when the kinds differ."""
    closed: list[str] = []
    for path, pair in _pairs_of_leaves(a, b, carried=carried):
        if any(path.startswith(f"{above}/") for above in closed):
            continue
        name = f"{aspect}/{path}" if aspect else path
        if findings.compare_leaf(subject, name, pair, base, places):
            closed.append(path)


def _pairs_of_leaves(a: Leaves, b: Leaves, *, carried: bool) -> Iterator[tuple[str, tuple[Leaf | None, Leaf | None]]]:
    """Yield the pairs of leaves that are compared, with their paths."""
    for path in sorted(a.keys() | b.keys()):
        pair = (a.get(path), b.get(path))
        if not (carried and path in _NOT_COMPARED_IN_CARRIERS) and not _is_absent_pose(pair):
            yield path, pair


def _is_absent_pose(pair: tuple[Leaf | None, Leaf | None]) -> bool:
    """Whether it is the pose of a part that one robot lacks; the other values of the part are reported anyway."""
    one = pair[0] or pair[1]
    return None in pair and one is not None and isinstance(one.value, PoseValue)


def compare_parts(
    findings: ComparisonFindings, subject: ComparedSubject, a: Iterable[LinkPart], b: Iterable[LinkPart], base: Base
) -> None:
    """Compare the parts of two links, joints or models."""
    groups_a, groups_b = _by_kind(a), _by_kind(b)
    renamed: dict[str, str] = {}
    for kind in sorted(groups_a.keys() | groups_b.keys()):  # collisions, then sensors that name them
        pairs, only_a, only_b = match(groups_a.get(kind, []), groups_b.get(kind, []), findings.terms, base)
        if kind == "collision":
            renamed = {other.name: one.name for one, other in pairs if one.name != other.name}
        for one, other in pairs:
            name = f"{kind} {one.name!r}"
            carried, places = one.carried or other.carried, (one.where, other.where)
            leaves = _with_names(other.leaves, renamed) if kind == "sensor" and renamed else other.leaves
            compare_leaves(findings, subject, one.leaves, leaves, base, places, name, carried=carried)
            _note_renamed(findings, subject, one, other)
        for in_a, rest in ((True, only_a), (False, only_b)):
            for part in rest:
                name = f"{kind} {part.name!r}"
                findings.add_one_sided(subject, name, kind, part.where, in_a=in_a, only=part.only, carried=part.carried)


def _with_names(sensor: Leaves, renamed: Mapping[str, str]) -> Leaves:
    """Return the values of a sensor with the names that the other robot gives to the collisions it watches.

    Gazebo and conversions rename collisions, in the sensor too.
    """
    found = dict(sensor)
    for path, leaf in sensor.items():
        if path.startswith(_WATCHED) and isinstance(leaf.value, Text) and leaf.value.text in renamed:
            found[path] = replace(leaf, value=Text(renamed[leaf.value.text]))
    return found


def _note_renamed(findings: ComparisonFindings, subject: ComparedSubject, a: LinkPart, b: LinkPart) -> None:
    terms = findings.terms
    if a.name != b.name and terms.format_a is terms.format_b:
        message = f"{a.kind} {a.name!r} of {subject} is called {b.name!r} in {terms.b}"
        findings.add_note(subject, f"{a.kind} {a.name!r}/name", message, (a.where, b.where))


def _by_kind(parts: Iterable[LinkPart]) -> dict[str, list[LinkPart]]:
    found = defaultdict[str, list[LinkPart]](list)
    for part in parts:
        found[part.kind].append(part)
    return found


def match(a: list[LinkPart], b: list[LinkPart], terms: Terms, base: Base) -> Matched:
    """Pair the parts of one kind."""
    if not any(part.kind in _BY_CONTENT for part in (*a, *b)):
        return _pair_by_name(a, b, base)
    pairs, left_a, left_b = _pair_equal(a, b, terms, base)
    if _are_few(left_a, left_b):
        alike, left_a, left_b = _pair_alike(left_a, left_b, terms, base)
        return [*pairs, *alike], left_a, left_b
    named, left_a, left_b = _pair_by_key(left_a, left_b, attrgetter("name"), attrgetter("name"))
    of_a, of_b = partial(_placed_shape, base=base.a), partial(_placed_shape, base=base.b)
    placed, left_a, left_b = _pair_by_key(left_a, left_b, of_a, of_b)
    alike, left_a, left_b = _pair_by_key(left_a, left_b, _shape, _shape)
    return [*pairs, *named, *placed, *alike], left_a, left_b


def _pair_by_name(a: list[LinkPart], b: list[LinkPart], base: Base) -> Matched:
    """Pair parts of one name; where several parts of a robot have it, equal ones are paired first."""
    equal: list[Pair] = []
    if len({part.name for part in a}) < len(a):
        of_a, of_b = partial(_content, base=base.a), partial(_content, base=base.b)
        equal, a, b = _pair_by_key(a, b, lambda one: (one.name, of_a(one)), lambda one: (one.name, of_b(one)))
    named, a, b = _pair_by_key(a, b, attrgetter("name"), attrgetter("name"))
    return [*equal, *named], a, b


def _pair_equal(a: list[LinkPart], b: list[LinkPart], terms: Terms, base: Base) -> Matched:
    """Pair equal shapes, those of one name first.

    Of many shapes, those of one content are paired by a table, and the rest one by one if only few are left.
    """
    exact: list[Pair] = []
    if not _are_few(a, b):
        of_a, of_b = partial(_content, base=base.a), partial(_content, base=base.b)
        named, a, b = _pair_by_key(a, b, lambda one: (one.name, of_a(one)), lambda one: (one.name, of_b(one)))
        renamed, a, b = _pair_by_key(a, b, of_a, of_b)
        exact = [*named, *renamed]
        if not _are_few(a, b):
            return exact, a, b
    pairs, a, b = _pair_fitting(a, b, lambda one, other: one.name == other.name and is_same(one, other, terms, base))
    same, a, b = _pair_fitting(a, b, lambda one, other: is_same(one, other, terms, base))
    return [*exact, *pairs, *same], a, b


def _are_few(a: Sized, b: Sized) -> bool:
    return len(a) * len(b) <= _MOST_PAIRS


def _content(part: LinkPart, base: Transform) -> Hashable:
    """Return a key for everything about a part but its name, rounded, as seen from a frame."""
    written = ((path, leaf) for path, leaf in part.leaves.items() if leaf.value != leaf.default)
    return frozenset((path, show(leaf.value.seen_from(base))) for path, leaf in written)


def _pair_by_key(
    a: list[LinkPart], b: list[LinkPart], key_a: Callable[[LinkPart], Hashable], key_b: Callable[[LinkPart], Hashable]
) -> Matched:
    """Pair each part with the first free one of an equal key."""
    free = defaultdict[Hashable, deque[LinkPart]](deque)
    for other in b:
        free[key_b(other)].append(other)
    pairs = [(one, same.popleft()) for one in a if (same := free.get(key_a(one)))]
    return _with_rest(pairs, a, b)


def _pair_fitting(a: list[LinkPart], b: list[LinkPart], fits: Fits) -> Matched:
    """Pair each part with the first free one that fits it."""
    pairs: list[Pair] = []
    free = list(b)
    for one in a:
        found = next((index for index, other in enumerate(free) if fits(one, other)), None)
        if found is not None:
            pairs.append((one, free.pop(found)))
    return _with_rest(pairs, a, b)


def _with_rest(pairs: list[Pair], a: list[LinkPart], b: list[LinkPart]) -> Matched:
    """Return pairs with the parts of each robot that are in none of them."""
    gone = {id(part) for pair in pairs for part in pair}
    left_a, left_b = ([part for part in parts if id(part) not in gone] for parts in (a, b))
    return pairs, left_a, left_b


def _pair_alike(a: list[LinkPart], b: list[LinkPart], terms: Terms, base: Base) -> Matched:
    """Pair shapes that differ, the most similar first; shapes of two kinds are only paired if they have one name."""
    near = [
        (_distance(one, other, terms, base), i, j)
        for i, one in enumerate(a)
        for j, other in enumerate(b)
        if one.name == other.name or _shape(one) == _shape(other)
    ]
    pairs: dict[int, int] = {}
    for _, i, j in sorted(near):
        if i not in pairs and j not in pairs.values():
            pairs[i] = j
    return _with_rest([(a[i], b[j]) for i, j in sorted(pairs.items())], a, b)


def _distance(a: LinkPart, b: LinkPart, terms: Terms, base: Base) -> int:
    """Count the values that differ; another name counts as two."""
    found = ComparisonFindings(terms)
    compare_leaves(found, ComparedSubject("", ""), a.leaves, b.leaves, base, carried=a.carried or b.carried)
    # A name means little for a shape (Gazebo and conversions rename both), so a shape that moved
    # and kept its name may still be another one.
    return len(found.items) + (0 if a.name == b.name else 2)


def _placed_shape(part: LinkPart, base: Transform) -> Hashable:
    """Return a key for the geometry of a shape and its place to a micrometer, whatever its material is."""
    leaf = part.leaves.get("pose")
    place = leaf.value.seen_from(base) if leaf else None
    where = (round(each, 6) + 0.0 for each in place.pose.translation) if isinstance(place, PoseValue) else ()
    return _shape(part), tuple(where)


def _shape(part: LinkPart) -> object:
    leaf = part.leaves.get("geometry")
    return leaf.value if leaf else None


def is_same(a: LinkPart, b: LinkPart, terms: Terms, base: Base) -> bool:
    """Whether two parts are equal but for their names."""
    found, nothing = ComparisonFindings(terms), ComparedSubject("", "")
    pairs = _pairs_of_leaves(a.leaves, b.leaves, carried=a.carried or b.carried)
    return not any(found.compare_leaf(nothing, path, pair, base, UNKNOWN) for path, pair in pairs)


def unmatched(a: Iterable[LinkPart], b: Iterable[LinkPart], terms: Terms, base: Base) -> Iterator[LinkPart]:
    """Yield the parts for which the other robot has no equal one."""
    groups_b = _by_kind(b)
    for kind, parts in _by_kind(a).items():
        others = groups_b.get(kind, [])
        pairs, only, _ = (
            _pair_equal(parts, others, terms, base) if kind in _BY_CONTENT else match(parts, others, terms, base)
        )
        yield from only
        yield from (one for one, other in pairs if not is_same(one, other, terms, base))
