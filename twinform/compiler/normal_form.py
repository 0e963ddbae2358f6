"""The normal form of a file: its XML without the differences of spelling that mean nothing.

Two files with equal normal forms state the same in the same notation. *There and back*, from one format to the other
and back, means that the robot is the same (`twinform.diff`), and that the normal form is: every name, attribute and
text of the source that is not the spelling of a default is back, and nothing else has come along.

    form = twinform.normal_form("robot.urdf")
    form.compare(twinform.normal_form("robot_that_came_back.urdf"))

What counts, and what does not:

* An element is known by its tag and its name, in URDF's `<gazebo>` by its reference; else by its place among its like.
  The order of siblings does not count, as readers find them by their names; those without one are distinguished by it.
* Several `<gazebo>` of one reference are one, and a tag in them, such as `<mu1>`, is what it means in SDF. What they
  repeat is taken once.
* Values are of the types of the facts tables. Numbers are equal to a share of 1e-9, truths whatever way they are
  spelled; a limit of 1e16 and beyond is none. A pose is a rigid transform. URIs, names and other texts are taken
  literally.
* The notation of a rotation (`degrees`, `rotation_format`, `quat_xyzw`) counts where something is turned. What is not
  turned is so in every notation, and naming one adds nothing.
* A value equal to its default in the facts table of the file's own version states nothing. Neither does an element in
  which nothing is left, unless it means something by being there: required ones, those that may be repeated, shapes,
  materials, and what the compiler does not look into, which has to come back as it was.
* Text and attributes of what no table knows count literally, with white space folded; so does all order in there.
* Comments, processing instructions and the prefixes of namespaces do not count.
"""

from collections.abc import Iterator
from dataclasses import field
from enum import StrEnum
from pathlib import Path

from twinform.compiler.build_normal_form import builder
from twinform.compiler.compare.compared_values import show
from twinform.compiler.compare.comparison import Side
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.front_ends import declared_version
from twinform.compiler.input.loading import LoadOptions, read, read_tree
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.normal_form_parts import TEXT, Key, NormalPart, same, text_of
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.wording import cut
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.schemas import XmlElement, path_of

_LONGEST = 100
_ITSELF = "."
"""The step from an element to what is no value of its own."""


class DifferenceKind(StrEnum):
    """The way in which two normal forms differ at a place."""

    MISSING = "missing"
    CHANGED = "changed"
    ADDED = "added"
    LEFT_OVER = "left over"
    """A carrier or an annotation that has come along."""
    ORDER = "order"


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """A value that is missing, changed or new in the file that came back from a round trip."""

    kind: DifferenceKind
    source: Side
    back: Side

    @property
    def location(self) -> Location:
        """The place in the source, or in the other file if the source does not have the value."""
        return self.source.location if self.source.text is not None else self.back.location

    @property
    def message(self) -> str:
        """The discrepancy as text."""
        where = self.location
        place = f"{where.file}:{where.line}: {where.path}"
        if self.kind is DifferenceKind.MISSING:
            return f"{place}: {self.source.text} is not back"
        if self.kind in {DifferenceKind.ADDED, DifferenceKind.LEFT_OVER}:
            return f"{place}: {self.back.text} was not in the source"
        return f"{place}: {self.source.text} became {self.back.text}"


@dataclass(slots=True)
class NormalFormComparison:
    """A comparison of two normal forms, with the names of their files."""

    source: str
    back: str
    _places: dict[XmlElement, int] = field(default_factory=dict[XmlElement, int])

    def roots(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """Yield the discrepancies between two whole files."""
        if source.element.tag == back.element.tag:
            yield from self.parts(source, back)
        else:
            yield Discrepancy(DifferenceKind.CHANGED, self._in_source(source), self._in_back(back))

    def parts(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """Yield the discrepancies between two parts of one key."""
        yield from self._compare_values(source, back)
        pairs = _pair_children(source, back)
        found = frozenset(pairs.values())
        for key, child in source.children.items():
            if key in pairs:
                yield from self.parts(child, back.children[pairs[key]])
            else:
                yield Discrepancy(DifferenceKind.MISSING, self._in_source(child), Side())
        for key, child in back.children.items():
            if key not in found:
                yield Discrepancy(_kind_of_new(key.tag), Side(), self._in_back(child))
        yield from self._compare_order(source, back)

    def _compare_values(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        for step, value in source.values.items():
            other = back.values.get(step)
            if other is None:
                yield Discrepancy(DifferenceKind.MISSING, self._in_source(source, step), Side())
            elif not same(value, other):
                yield Discrepancy(DifferenceKind.CHANGED, self._in_source(source, step), self._in_back(back, step))
        for step in back.values:
            if step not in source.values:
                yield Discrepancy(_kind_of_new(step.removeprefix("@")), Side(), self._in_back(back, step))

    def _compare_order(self, source: NormalPart, back: NormalPart) -> Iterator[Discrepancy]:
        """Yield the first change of order, if the order of children counts."""
        if not (source.ordered or back.ordered):
            return
        mine = [key for key in source.children if key in back.children]
        theirs = [key for key in back.children if key in source.children]
        at = next((n for n, (one, other) in enumerate(zip(mine, theirs, strict=True)) if one != other), None)
        if at is not None:
            one, other = source.children[mine[at]], back.children[theirs[at]]
            yield Discrepancy(DifferenceKind.ORDER, self._in_source(one), self._in_back(other))

    def _in_source(self, part: NormalPart, step: str = _ITSELF) -> Side:
        return self._side_of(self.source, part, step)

    def _in_back(self, part: NormalPart, step: str = _ITSELF) -> Side:
        return self._side_of(self.back, part, step)

    def _side_of(self, file: str, part: NormalPart, step: str) -> Side:
        where = Location(file, part.element.sourceline or 0, path_of(part.element, self._places))
        if step.startswith("@"):
            text = part.element.get(step[1:])
            return Side(show(part.values[step]) if text is None else repr(cut(text, _LONGEST)), where.at(step))
        return Side(repr(cut(text_of(part.element), _LONGEST)) if step == TEXT else _start_of(part.element), where)


def _pair_children(source: NormalPart, back: NormalPart) -> dict[Key, Key]:
    """Pair the children of two parts: by key, or by order where one child of a pair has a name and the other none."""
    pairs = {key: key for key in source.children if key in back.children}
    left: dict[str, list[Key]] = {}
    for key in reversed(back.children):
        if key not in pairs:
            left.setdefault(key.tag, []).append(key)
    for key in source.children:
        candidates = left.get(key.tag) if key not in pairs else None
        # A name that a conversion synthesized, and did not take back, is a discrepancy of its own:
        # found at the part, and not as one part that is missing and another that is new.
        if candidates and bool(candidates[-1].name) != bool(key.name):
            pairs[key] = candidates.pop()
    return pairs


def _kind_of_new(name: str) -> DifferenceKind:
    return DifferenceKind.LEFT_OVER if name.startswith(f"{{{NAMESPACE}}}") else DifferenceKind.ADDED


def _start_of(element: XmlElement) -> str:
    """Return the start tag and text of an element, shortened."""
    tag = str(element.tag).rpartition("}")[2]
    attributes = "".join(f' {str(name).rpartition("}")[2]}="{value}"' for name, value in element.items())
    inside = " ".join((element.text or "").split())
    return cut(f"<{tag}{attributes}>{inside}" if inside or len(element) else f"<{tag}{attributes}/>", _LONGEST)


_FORMATS = {"robot": "urdf", "sdf": "sdf", "mujoco": "mjcf"}


@dataclass(frozen=True, slots=True)
class NormalForm:
    """The content of a file as a tree of parts, with the name of the file."""

    root: NormalPart
    file: str = ""

    @classmethod
    def of(cls, tree: XmlElement, file: str = "") -> "NormalForm":
        """Make the normal form of a tree which `check` or `convert` has read."""
        # It looks at the two compare_files as their author would, with types and defaults from the facts
        # tables, and at nothing of the compiler. A judge that compared the IR did not see what has
        # no field. About 30 us an element.
        format = _FORMATS[str(tree.tag)]
        return cls(builder(format, declared_version(tree, format, DiagnosticSink())).root(tree), file)

    def compare(self, back: "NormalForm") -> tuple[Discrepancy, ...]:
        """Return the discrepancies of a file that came back from a round trip, in the order of this one."""
        return tuple(NormalFormComparison(self.file, back.file).roots(self.root, back.root))


def normal_form(source: str | Path | bytes, *, name: str = "") -> NormalForm:
    """Make the normal form of a file, or of the bytes of one; a xacro file is expanded.

    The file may have errors, but it has to be XML of one of the formats.

    Raises:
        CompileError: the file cannot be read as URDF, SDF or MJCF.
    """
    if not isinstance(source, bytes):
        checked = read(source, LoadOptions(), name=name)
        if checked.tree is None:
            raise CompileError(checked.diagnostics, unreadable=True)
        return NormalForm.of(checked.tree, checked.path)
    sink = DiagnosticSink(file=name or "<bytes>")
    try:
        tree, _ = read_tree(source, sink)
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error
    return NormalForm.of(tree, sink.file)
