"""What a version of SDF lacks, as bits of the census: subtrees without any of them have nothing to leave out."""

from collections.abc import Iterable, Iterator
from functools import cache

from twinform.ir import PLAIN, Document, Node, Pose, bits_of
from twinform.ir.census import RARE, union_of
from twinform.ir.record import fields_of
from twinform.ir.tree_walks import classes_in
from twinform.passes.sdf_versions.spans import ElementContent, VersionSpan, shape
from twinform.schemas import Version, table

_Kinds = frozenset[type[Node]]


@cache
def bits_lacking(version: Version) -> int:
    """The bits of what a version does not have, has but once, or has as another thing; and of untyped parts."""
    return PLAIN | union_of(bit for kinds, form in _shapes(version) for bit in _bits(kinds, form, version))


def _shapes(version: Version) -> Iterator[tuple[_Kinds, ElementContent]]:
    """The shape of each element of a version that has a node, and of which classes that may be."""
    seen: set[tuple[_Kinds, int]] = set()
    queue: list[tuple[_Kinds, ElementContent]] = [(frozenset({Document}), shape(table("sdf").root))]
    for kinds, form in queue:  # grows while it is walked
        yield kinds, form
        for inner, span in _inner(kinds, form):
            row = span.row(version)
            if inner and row is not None and (inner, id(row)) not in seen:
                seen.add((inner, id(row)))
                queue.append((inner, span.shape(row)))


def _inner(kinds: _Kinds, form: ElementContent) -> Iterator[tuple[_Kinds, VersionSpan]]:
    for place, span in form.fields.items():
        if not any(_is_pose_of_its_own(kind, place) for kind in kinds):
            yield _classes_in(_holders(kinds, place), _field(place)), span
    for kind, span in form.kinds.items():
        yield _of_kind(kinds, span, kind), span


def _bits(kinds: _Kinds, form: ElementContent, version: Version) -> Iterator[int]:
    for place, span in form.fields.items():
        holders, field = _holders(kinds, place), _field(place)
        if span.row(version) is None:
            yield from (bits_of(holder, field) for holder in holders if field in fields_of(holder))
        elif place in form.lacking(version):
            yield from (bits_of(kind, place) for kind in kinds if _is_pose_of_its_own(kind, place))
        if span.repetition(version):
            yield from map(bits_of, _classes_in(holders, field))
    for kind, span in form.kinds.items():
        if span.row(version) is None:
            yield from map(bits_of, _of_kind(kinds, span, kind))


def _is_pose_of_its_own(kind: type[Node], place: str) -> bool:
    """Whether a pose has a bit where it stands, since it may express less there than elsewhere."""
    return place in RARE.get(kind, ()) and Pose in classes_in(kind, place)


def _holders(kinds: _Kinds, place: str) -> _Kinds:
    """The classes that have the field of a place, which may be one node further in."""
    outer = place.rpartition(".")[0]
    return _classes_in(kinds, outer) if outer else kinds


def _field(place: str) -> str:
    return place.rpartition(".")[2]


def _classes_in(kinds: Iterable[type[Node]], field: str) -> _Kinds:
    return frozenset(inner for kind in kinds if field in fields_of(kind) for inner in classes_in(kind, field))


def _of_kind(kinds: _Kinds, span: VersionSpan, kind: str) -> _Kinds:
    """The classes of one of the kinds that a field may hold."""
    every = _classes_in(kinds, span.rows[0][2].place or "")
    return frozenset(each for each in every if fields_of(each)["kind"].default == kind)
