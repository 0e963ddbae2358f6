"""Version ranges of SDF elements and attributes, by name and by IR field."""

from collections.abc import Container
from dataclasses import dataclass, field
from functools import cache

from twinform.passes.carriers.sdf_versions import VersionCondition
from twinform.schemas import Fact, Version, table

_FIRST: Version = (0, 0)
_LAST: Version = (99, 99)


@dataclass(slots=True)
class VersionSpan:
    """When one part exists: every row of the table that describes it, and from when to when."""

    rows: list[tuple[Version, Version, Fact]] = field(default_factory=list[tuple[Version, Version, Fact]])
    _found: dict[Version, Fact | None] = field(default_factory=dict[Version, Fact | None])

    def row(self, version: Version) -> Fact | None:
        """The row of a version; None where it does not have the part."""
        if version not in self._found:  # asked for each part of a model, when all rows are there
            fitting = (row for since, until, row in self.rows if since <= version <= until)
            self._found[version] = next(fitting, None)
        return self._found[version]

    def condition(self, version: Version, index: int | None = None) -> VersionCondition:
        """The nearest versions that have it, on both sides of one that does not."""
        later = [since for since, _, _ in self.rows if since > version]
        earlier = [until for _, until, _ in self.rows if until < version]
        return VersionCondition(since=min(later, default=None), until=max(earlier, default=None), index=index)

    def repetition(self, version: Version) -> "VersionSpan | None":
        """When it may stand more than once, if that is in other versions alone."""
        row = self.row(version)
        if row is None or row.repeats:
            return None
        repeating = [each for each in self.rows if each[2].repeats]
        return VersionSpan(repeating) if repeating else None

    def containers(self) -> "VersionSpan":
        """When it has children, which in other versions may be a value."""
        return VersionSpan([each for each in self.rows if each[2].type is None])

    @property
    def is_split(self) -> bool:
        """Whether it is one thing in some versions and another one in others."""
        return len({row.reference for _, _, row in self.rows}) > 1

    def shape(self, row: Fact) -> "ElementContent":
        """What it may hold by the row of a version, and by those of others where it is another thing there."""
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
    """What an element may hold: by name (`@` for attributes), by field of the IR, and by kind for one of several."""

    fact: Fact
    names: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    fields: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    kinds: dict[str, VersionSpan] = field(default_factory=dict[str, VersionSpan])
    _lacking: dict[Version, tuple[str, ...]] = field(default_factory=dict[Version, tuple[str, ...]])

    def lacking(self, version: Version) -> tuple[str, ...]:
        """The fields of which a version may lack something, at any depth."""
        if version not in self._lacking:
            found = [name for name, span in self.fields.items() if not _has_all(span, whole(version), version)]
            if not all(_has_all(span, whole(version), version) for span in self.kinds.values()):
                found.append(next(iter(self.kinds.values())).rows[0][2].place or "")
            self._lacking[version] = tuple(found)
        return self._lacking[version]


def _pairs_of_spans(
    mine: ElementContent, theirs: ElementContent
) -> list[tuple[dict[str, VersionSpan], dict[str, VersionSpan]]]:
    return [(mine.names, theirs.names), (mine.fields, theirs.fields)]


@cache
def shape(definition: str) -> ElementContent:
    """The shape of a definition of SDF."""
    return _shape(table("sdf").definitions[definition])


_inner: dict[int, ElementContent] = {}


def shape_of(row: Fact) -> ElementContent:
    """The shape of a row, which may refer to a definition."""
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
    """Enter the fields that rows fill; a container without a node passes on to its rows when it exists."""
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
    """The definitions of which a version has everything that any version has, all the way down."""
    definitions = table("sdf").definitions
    found = set(definitions)
    # A greatest fixed point: definitions refer to each other in circles (a model holds models), so
    # all count as whole until one of their parts is not.
    while lacking := {name for name in found if not _is_whole(shape(name), found, version)}:
        found -= lacking
    return frozenset(found)


def _is_whole(form: ElementContent, found: Container[str], version: Version) -> bool:
    return all(_has_all(span, found, version) for span in form.names.values())


def _has_all(span: VersionSpan, found: Container[str], version: Version) -> bool:
    """Whether a version has a part and, by the definitions that were found to be whole, everything in it."""
    row = span.row(version)
    if row is None or span.is_split or span.repetition(version):
        return False
    return row.reference in found if row.reference else _is_whole(shape_of(row), found, version)
