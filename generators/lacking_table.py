"""Makes the table of what versions of SDF lack from the facts tables."""

from collections.abc import Iterable, Iterator, Mapping
from textwrap import fill

from twinform.ir import Document, Node, Pose
from twinform.ir.record import fields_of
from twinform.ir.rewrite import RARE, classes_in
from twinform.passes.sdf_versions.spans import ElementContent, VersionSpan, has_all, is_whole, shape
from twinform.schemas import Version, parse_version, table

# Each conversion asks for one version, and the answer takes most of the facts tables: a quarter of
# the time that the command takes for a small robot.
_HEAD = '''\
"""What each version of SDF lacks: made by `make generate` from the facts tables, not to be edited."""

from collections.abc import Mapping

'''
_INCOMPLETE = "Definitions that lack something in a version, at any depth, that another version has."
_LACKING = "Nodes and fields that a version lacks, allows only once or defines otherwise."
_WIDTH = 112


def lacking_table() -> str:
    """The module with both tables."""
    versions = {version: parse_version(version) for version in table("sdf").versions}
    complete = {version: complete_definitions(number) for version, number in versions.items()}
    incomplete = {version: set(table("sdf").definitions) - found for version, found in complete.items()}
    lacking = {version: lacking_parts(number, complete[version]) for version, number in versions.items()}
    return f"{_HEAD}{_written('INCOMPLETE', incomplete, _INCOMPLETE)}\n{_written('LACKING', lacking, _LACKING)}"


def _written(name: str, words: Mapping[str, Iterable[str]], about: str) -> str:
    rows = (f'    "{version}": """\n{fill(" ".join(sorted(each)), _WIDTH)}\n""",\n' for version, each in words.items())
    return f'{name}: Mapping[str, str] = {{\n{"".join(rows)}}}\n"""{about}"""\n'


def complete_definitions(version: Version) -> frozenset[str]:
    """The definitions of which a version has all that any version has, at any depth."""
    definitions = table("sdf").definitions
    found = set(definitions)
    # A greatest fixed point: definitions refer to each other in circles (a model holds models), so
    # all count as whole until one of their parts is not.
    while lacking := {name for name in found if not is_whole(shape(name), found, version)}:
        found -= lacking
    return frozenset(found)


def lacking_parts(version: Version, complete: frozenset[str]) -> frozenset[str]:
    """The classes of nodes, and their fields, that a version lacks, allows only once or defines otherwise."""
    return frozenset(word for kinds, form in _shapes(version) for word in _words(kinds, form, version, complete))


_Kinds = frozenset[type[Node]]


def _shapes(version: Version) -> Iterator[tuple[_Kinds, ElementContent]]:
    """Each element of a version that has a node: the classes of that node, and the content."""
    seen: set[tuple[_Kinds, int]] = set()
    queue: list[tuple[_Kinds, ElementContent]] = [(frozenset({Document}), shape(table("sdf").root))]
    for kinds, form in queue:  # grows while it is walked
        yield kinds, form
        for inner, span in _inner_shapes(kinds, form):
            row = span.row(version)
            if inner and row is not None and (inner, id(row)) not in seen:
                seen.add((inner, id(row)))
                queue.append((inner, span.shape(row)))


def _inner_shapes(kinds: _Kinds, form: ElementContent) -> Iterator[tuple[_Kinds, VersionSpan]]:
    for place, span in form.fields.items():
        if not any(_is_pose_of_its_own(kind, place) for kind in kinds):
            yield _classes_in(_holders(kinds, place), _field(place)), span
    for kind, span in form.kinds.items():
        yield _of_kind(kinds, span, kind), span


def _words(kinds: _Kinds, form: ElementContent, version: Version, complete: frozenset[str]) -> Iterator[str]:
    for place, span in form.fields.items():
        holders, field = _holders(kinds, place), _field(place)
        if span.row(version) is None:
            yield from (_word(holder, field) for holder in holders if field in fields_of(holder))
        elif not has_all(span, complete, version):
            yield from (_word(kind, place) for kind in kinds if _is_pose_of_its_own(kind, place))
        # That a file has several models shows at once, and every file has one.
        if Document not in kinds and span.repetition(version):
            yield from map(_word, _classes_in(holders, field))
    for kind, span in form.kinds.items():
        if span.row(version) is None:
            yield from map(_word, _of_kind(kinds, span, kind))


def _word(kind: type[Node], field: str = "") -> str:
    return f"{kind.__name__}.{field}" if field else kind.__name__


def _is_pose_of_its_own(kind: type[Node], place: str) -> bool:
    """Whether the pose in a field has a census bit of its own, because it may say less there than elsewhere."""
    return place in RARE.get(kind, ()) and Pose in classes_in(kind, place)


def _holders(kinds: _Kinds, place: str) -> _Kinds:
    """The classes of the node that has the last field of a place such as `limit.lower`."""
    outer = place.rpartition(".")[0]
    return _classes_in(kinds, outer) if outer else kinds


def _field(place: str) -> str:
    return place.rpartition(".")[2]


def _classes_in(kinds: Iterable[type[Node]], field: str) -> _Kinds:
    return frozenset(inner for kind in kinds if field in fields_of(kind) for inner in classes_in(kind, field))


def _of_kind(kinds: _Kinds, span: VersionSpan, kind: str) -> _Kinds:
    """The classes of one kind among the nodes that a field may hold."""
    every = _classes_in(kinds, span.rows[0][2].place or "")
    return frozenset(each for each in every if fields_of(each)["kind"].default == kind)
