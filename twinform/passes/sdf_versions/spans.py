"""Which versions of SDF have an element or attribute, by name, by IR field and as bits of the census."""

from collections.abc import Container
from dataclasses import field
from functools import cache

from twinform import ir
from twinform.dataclass import dataclass
from twinform.ir.rewrite import PLAIN, bits_of, union_of
from twinform.passes.carriers.sdf_versions import VersionCondition
from twinform.passes.sdf_versions.lacking import INCOMPLETE, LACKING
from twinform.schemas import Fact, Version, parse_version, print_version, table

_FIRST: Version = (0, 0)
_LAST: Version = (99, 99)


@dataclass(slots=True)
class VersionSpan:
    """The versions that have one part: the rows of the facts table that describe it, each with first and last."""

    rows: list[tuple[Version, Version, Fact]] = field(default_factory=list[tuple[Version, Version, Fact]])
    _found: dict[Version, Fact | None] = field(default_factory=dict[Version, Fact | None])

    def row(self, version: Version) -> Fact | None:
        """The row that describes the part in a version; None where the version lacks it."""
        if version not in self._found:  # asked for each part of a model, when all rows are there
            fitting = (row for since, until, row in self.rows if since <= version <= until)
            self._found[version] = next(fitting, None)
        return self._found[version]

    def condition(self, version: Version, index: int | None = None) -> VersionCondition:
        """The condition of a carrier: the nearest versions with the part, newer and older than one without."""
        later = [since for since, _, _ in self.rows if since > version]
        earlier = [until for _, until, _ in self.rows if until < version]
        return VersionCondition(since=min(later, default=None), until=max(earlier, default=None), index=index)

    def repetition(self, version: Version) -> "VersionSpan | None":
        """The versions that allow the part more than once; None where this one does, or none does."""
        row = self.row(version)
        if row is None or row.repeats:
            return None
        repeating = [each for each in self.rows if each[2].repeats]
        return VersionSpan(repeating) if repeating else None

    def containers(self) -> "VersionSpan":
        """The versions in which the part has children; in others it may be a plain value."""
        return VersionSpan([each for each in self.rows if each[2].type is None])

    @property
    def is_split(self) -> bool:
        """Whether versions have different definitions of the part."""
        return len({row.reference for _, _, row in self.rows}) > 1

    def shape(self, row: Fact) -> "ElementContent":
        """The content of the part by the row of a version, and by all rows where definitions differ."""
        if not self.is_split:
            return shape_of(row)
        merged = ElementContent(shape_of(row).fact)
        for since, until, each in self.rows:
            for mine, theirs in _pairs_of_spans(merged, shape_of(each)):
                for name, span in theirs.items():
                    # The inner parts of a row exist no longer than the row itself.
                    clipped = [(max(since, first), min(until, last), inner) for first, last, inner in span.rows]
                    mine.setdefault(name, VersionSpan()).rows.extend(clipped)
        return merged


@dataclass(slots=True)
class ElementContent:
    """What an element may hold: by name (`@` for attributes), by IR field, and by kind where a field has several."""

    fact: Fact
    names: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    fields: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    kinds: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    _lacking: dict[Version, tuple[str, ...]] = field(default_factory=dict[Version, tuple[str, ...]])

    def lacking(self, version: Version) -> tuple[str, ...]:
        """The IR fields in which a version may lack something, at any depth."""
        if version not in self._lacking:
            found = [name for name, span in self.fields.items() if not has_all(span, whole(version), version)]
            if not all(has_all(span, whole(version), version) for span in self.kinds.values()):
                found.append(next(iter(self.kinds.values())).rows[0][2].place or "")
            self._lacking[version] = tuple(found)
        return self._lacking[version]


def _pairs_of_spans(
    mine: ElementContent, theirs: ElementContent
) -> list[tuple[dict[str, VersionSpan], dict[str, VersionSpan]]]:
    return [(mine.names, theirs.names), (mine.fields, theirs.fields)]


@cache
def shape(definition: str) -> ElementContent:
    """The content of a definition of SDF."""
    return _shape(table("sdf").definitions[definition])


def has_shape(version: str, kind: str) -> bool:
    """Whether a version of SDF has a kind of shape."""
    span = shape("geometry").kinds.get(kind)
    return span is not None and span.row(parse_version(version)) is not None


_inner: dict[int, ElementContent] = {}


def shape_of(row: Fact) -> ElementContent:
    """The content of a row, which may refer to a definition."""
    if row.reference:
        return shape(row.reference)
    if id(row) not in _inner:  # the table is made once and kept
        _inner[id(row)] = _shape(row)
    return _inner[id(row)]


def _shape(fact: Fact) -> ElementContent:
    made = ElementContent(fact)
    for row in fact.rows:
        made.names.setdefault(row.name, VersionSpan()).rows.append((row.since, row.until, row))
    _collect(fact, made, _FIRST, _LAST)
    return made


def _collect(fact: Fact, made: ElementContent, since: Version, until: Version) -> None:
    """Add the fields that rows fill; the rows of a container without a node last no longer than the container."""
    for row in fact.rows:
        first, last = max(since, row.since), min(until, row.until)
        if row.place == ".":
            _collect(table("sdf").resolve(row), made, first, last)
        elif row.place and not row.place.startswith("/"):
            spans, key = (made.kinds, row.kind) if row.kind else (made.fields, row.place)
            spans.setdefault(key, VersionSpan()).rows.append((first, last, row))
            if row.type:  # the attributes of a leaf are fields of the node around it
                _collect(row, made, first, last)


@cache
def whole(version: Version) -> frozenset[str]:
    """The definitions that are complete in a version: it has all that any version has in them, at any depth."""
    return frozenset(table("sdf").definitions) - frozenset(INCOMPLETE[print_version(version)].split())


@cache
def bits_lacking(version: Version) -> int:
    """The census bits of what a version lacks, allows only once or defines otherwise, and of untyped parts."""
    # A subtree without any of these bits has nothing to leave out.
    words = (word.partition(".") for word in LACKING[print_version(version)].split())
    return PLAIN | union_of(bits_of(getattr(ir, kind), *filter(None, [field])) for kind, _, field in words)


def is_whole(form: ElementContent, found: Container[str], version: Version) -> bool:
    """Whether a version has every part of an element, given the definitions found to be complete."""
    return all(has_all(span, found, version) for span in form.names.values())


def has_all(span: VersionSpan, found: Container[str], version: Version) -> bool:
    """Whether a version has a part with everything in it, given the definitions found to be complete."""
    row = span.row(version)
    if row is None or span.is_split or span.repetition(version):
        return False
    return row.reference in found if row.reference else is_whole(shape_of(row), found, version)
