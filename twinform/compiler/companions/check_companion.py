"""Checks of companion files: reads one, and the robots that it may be for, and reports what is wrong in it."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from twinform.compiler.companions.check_controllers import report_controllers
from twinform.compiler.companions.check_names import KnownParts, report_names
from twinform.compiler.companions.check_semantics import report_semantics
from twinform.compiler.companions.check_values import report_footprints, report_limits, report_repeated
from twinform.compiler.companions.find_robots import (
    MOST_ROBOTS,
    Candidates,
    find_robots,
    is_semantic,
    semantics_around,
)
from twinform.compiler.companions.name_places import Leaf, Mention, NameSet, Step, mentions
from twinform.compiler.companions.robot_parts import RobotParts, read_parts
from twinform.compiler.companions.srdf_tree import SrdfTree, leaves_of, read_srdf
from twinform.compiler.companions.yaml_leaves import YamlError, YamlText, is_surely_meant, may_name_parts, read_yaml
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import bytes_of
from twinform.compiler.input.parsing import UnreadableError
from twinform.diagnostics import DiagnosticSink, Location, Span, rules
from twinform.text import Lines

_ENDINGS = (".yaml", ".yml")


def may_be_companion(path: Path) -> bool:
    """Whether a file may be a companion file, by its name."""
    return is_semantic(path) or is_yaml(path)


def is_yaml(path: Path) -> bool:
    """Whether a file is YAML, by its name."""
    return path.name.lower().endswith(_ENDINGS)


def is_companion(path: Path, data: bytes) -> bool:
    """Whether a file names parts of a robot: SRDF by its name, and YAML by its keys."""
    if is_semantic(path):
        return True
    if not is_yaml(path) or not may_name_parts(data):
        return False
    try:
        found = read_yaml(data)
    except YamlError:
        return is_surely_meant(data)
    return not found.has_own_tags and next(mentions(found.leaves), None) is not None


def check_if_companion(path: Path, load_options: LoadOptions) -> LoadResult | None:
    """Check a file if it is a companion file; None for any other."""
    if not may_be_companion(path):
        return None
    try:
        data = bytes_of(path, DiagnosticSink(str(path)), load_options)
    except UnreadableError:
        return None
    return check_companion(path, load_options, data) if is_companion(path, data) else None


def check_companion(path: Path, load_options: LoadOptions, data: bytes | None = None) -> LoadResult:
    """Check a companion file against the robots that it may be for; `data` is its content, where it is at hand."""
    sink = DiagnosticSink(str(path), load_options.strict)
    load_options.search.seen.add(path)
    try:
        data = bytes_of(path, sink, load_options) if data is None else data
        checked = _check_srdf if is_semantic(path) else _check_yaml
        return checked(path, data, sink, load_options)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True)


def _check_srdf(path: Path, data: bytes, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    """Check an SRDF file.

    Raises:
        UnreadableError: it is no XML, or cannot be expanded.
    """
    srdf = read_srdf(path, data, sink, load_options)
    allowances = load_options.allowances(sink.file, sink.origins)
    allowances.read(data, sink)
    found = list(mentions(leaves_of(srdf)))
    robots = _robots_for(path, data, found, sink, load_options)
    inside = DiagnosticSink(srdf.name, sink.strict)
    if robots is not None:
        report_names(found, KnownParts(robots, (srdf,)), inside)
    report_semantics(srdf, robots[0] if robots and len(robots) == 1 else None, inside)
    sink.extend(inside.diagnostics)
    allowances.checked, allowances.tolerant = True, load_options.tolerant
    allowances.settle(sink)
    tree = None if sink.origins else srdf.root
    return LoadResult(
        sink.file,
        None,
        tuple(sink.diagnostics),
        tree=tree,
        content=data,
        origins=sink.origins,
        allowed=tuple(sink.allowed),
    )


def _check_yaml(path: Path, data: bytes, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    """Check a file of parameters."""
    try:
        parameters = read_yaml(data)
    except YamlError as error:
        where = Location(line=error.line, column=error.column)
        sink.report(rules.BROKEN_PARAMETERS, str(error), where)
        return LoadResult(sink.file, None, tuple(sink.diagnostics), content=data)
    allowances = load_options.allowances(sink.file)
    allowances.files[sink.file] = parameters.suppressions()
    place = _Places(parameters)
    leaves = [place.of_leaf(each) for each in parameters.leaves]
    report_repeated(parameters, place.of, sink)
    report_footprints(leaves, sink)
    found = list(mentions(leaves))
    robots = _robots_for(path, data, found, sink, load_options)
    if robots is not None:
        has_groups = any(each.kind == "group" for each in found)
        groups = _groups_beside(path, load_options) if has_groups else ()
        report_names(found, KnownParts(robots, groups), sink)
        if len(robots) == 1:
            report_limits(leaves, robots[0], sink)
    report_controllers(leaves, robots[0] if robots and len(robots) == 1 else None, sink)
    allowances.checked, allowances.tolerant = True, load_options.tolerant
    allowances.settle(sink)
    ordered = tuple(sorted(sink.diagnostics, key=lambda each: (each.location.line, each.location.column)))
    return LoadResult(sink.file, None, ordered, content=data, allowed=tuple(sink.allowed))


class _Places:
    """Turns the spans of a text into locations."""

    def __init__(self, parameters: YamlText) -> None:
        self._lines = Lines(parameters.text)

    def of(self, span: Span, path: str = "") -> Location:
        start, end = self._lines.place(span.start), self._lines.place(span.end)
        return Location("", start.line, path, start.column, end.line, end.column)

    def of_leaf(self, leaf: Leaf[Span]) -> Leaf[Location]:
        path: list[Step[Location]] = []
        whole = ""
        for each in leaf.path:
            whole = f"{whole}/{each.text}"
            path.append(Step(each.text, self.of(each.place, whole)))
        return Leaf(tuple(path), Step(leaf.value.text, self.of(leaf.value.place, whole)), leaf.beside)


_OF_ROBOT = frozenset({"joint", "driven joint", "interface", "link"})


def _robots_for(
    path: Path, data: bytes, found: Iterable[Mention[Location]], sink: DiagnosticSink, load_options: LoadOptions
) -> list[RobotParts] | None:
    """Return the robots that a file may be for; None, with a note, where that is not known.

    Groups and the like are looked up where there is no robot at all.
    """
    names = {each.name for each in found if each.kind in _OF_ROBOT}
    frames = {each.name for each in found if each.kind == "frame"}
    candidates = find_robots(path, data, load_options)
    if not names:
        return []
    robots = [] if len(candidates.robots) > MOST_ROBOTS else _read_all(candidates.robots, load_options)
    known = NameSet(name for each in robots if each is not None for name in (*each.links, *each.joints))
    is_fitting = any(name in known for name in names | frames)
    problem = _problem(candidates, robots, len(names), is_fitting=is_fitting)
    if problem:
        help = 'say which with --robot FILE, or in twinform.toml: [[files]] match = ["{}"], robot = "..."'
        sink.report(rules.ROBOT_NOT_FOUND, problem, Location(line=1), help=help.format(path.name))
        return None
    return [each for each in robots if each is not None and each.links]


def _read_all(paths: Iterable[Path], load_options: LoadOptions) -> list[RobotParts | None]:
    known = load_options.search.index.parts
    plain = replace(load_options, profiles=(), robot="")
    found: list[RobotParts | None] = []
    for path in paths:
        made = known.get((path, _key(load_options.arguments)), lambda path=path: read_parts(path, plain))
        found.append(made if isinstance(made, RobotParts) else None)
    return found


def _key(arguments: Mapping[str, str]) -> tuple[tuple[str, str], ...]:
    return tuple(sorted(arguments.items()))


def _problem(candidates: Candidates, robots: list[RobotParts | None], names: int, *, is_fitting: bool) -> str:
    """Say why so many names cannot be looked up; empty if they can. `is_fitting` is true if a robot has one of them."""
    count = len(candidates.robots)
    if not count or (robots and not any(each is None or each.links for each in robots)):
        return "no robot is found that this file is for, so the names in it are not looked up"
    if not robots:
        return f"this file may be for any of {count} robots, so the names in it are not looked up"
    broken = [path.name for path, each in zip(candidates.robots, robots, strict=True) if each is None]
    if broken:
        return f"{broken[0]} cannot be read as a whole, so the names in this file are not looked up"
    if not is_fitting and (candidates.by == "place" or (candidates.by == "package" and names > 1)):
        which = candidates.robots[0].name if count == 1 else f"{count} robots"
        return f"no name in this file is one of {which}; it seems to be for another robot"
    return ""


def _groups_beside(path: Path, load_options: LoadOptions) -> tuple[SrdfTree, ...]:
    """Return the SRDF files in the package of a file; none if one of them cannot be read."""
    found = [_srdf_of(each, load_options) for each in semantics_around(path, load_options.search)]
    return tuple(each for each in found if each is not None) if None not in found else ()


def _srdf_of(path: Path, load_options: LoadOptions) -> SrdfTree | None:
    def make() -> SrdfTree | None:
        sink = DiagnosticSink(str(path))
        try:
            return read_srdf(path, bytes_of(path, sink, load_options), sink, load_options)
        except UnreadableError:
            return None

    made = load_options.search.index.parts.get((path, _key(load_options.arguments)), make)
    return made if isinstance(made, SrdfTree) else None
