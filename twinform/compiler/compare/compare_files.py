"""Compares two files: reads their robots in the newest SDF version, and collects the differences for every reader."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Unpack

from twinform.compiler.compare.compared_robot import ComparedRobot, Leaves, LinkPart
from twinform.compiler.compare.comparison import (
    TOLERANCE,
    USUAL,
    Base,
    ComparedSubject,
    Comparison,
    ComparisonFindings,
    ComparisonOptions,
    Difference,
    Terms,
)
from twinform.compiler.compare.matching import compare_leaves, compare_parts
from twinform.compiler.compare.part_reader import PartReader
from twinform.compiler.compare.readers import ComparingReader, Memo, as_read_by, reconcile
from twinform.compiler.compare.robot_builder import build_robot
from twinform.compiler.compare.usd_terms import SINGLE_PRECISION
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.load_options import FileOptions
from twinform.compiler.input.loading import (
    Input,
    LoadOptions,
    LoadResult,
    garbage_collection_paused,
    is_usd,
    name_of_input,
    read,
)
from twinform.compiler.moved_paths import named_alike
from twinform.compiler.resolve_uris import LocalAssets
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, LineOrigins, Source
from twinform.ir import Document, Format, Frame, Joint, Model, Pose, World
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.option import require_options
from twinform.passes import Assets, Pass, Pipeline
from twinform.passes.carriers.misplaced import without_misplaced
from twinform.passes.carriers.token_mass import without_tokens
from twinform.passes.legalise.changed_names import RestoreNames, UniqueNames
from twinform.passes.legalise.to_sdf.sequence import to_sdf
from twinform.passes.legalise.to_urdf.restore_links import without_loose_floating
from twinform.passes.legalise.to_urdf.select_model import Selector
from twinform.passes.sdf_versions import raise_words
from twinform.passes.sdf_versions.replace_shapes import FoldCapsules, FoldShapeMeshes
from twinform.passes.shared.candidates import name_once_expanded, wanted_includes
from twinform.schemas import versions_of

_FILE = ""
"""The key for the parts of a file that are in no world and no model."""


@dataclass(frozen=True, slots=True)
class WorldSurroundings:
    """A world without its models, or, with an empty name, the parts of a file that are in no world and no model."""

    name: str
    leaves: Leaves
    parts: tuple[LinkPart, ...]
    where: Source | None

    @property
    def subject(self) -> ComparedSubject:
        """The subject of its differences."""
        return ComparedSubject("world", self.name) if self.name else ComparedSubject("file", "")


def read_surroundings(document: Document) -> dict[str, WorldSurroundings]:
    """Read the worlds of a document in the newest SDF version by name, and the parts beside them."""
    found = {world.name: _read_world(world) for world in document.worlds}
    beside = _read_beside_worlds(document)
    return {**found, _FILE: beside} if beside.parts or beside.leaves else found


def _read_world(world: World) -> WorldSurroundings:
    graph = FrameGraph(world)
    reader = PartReader(partial(_place_in_world, graph))
    leaves, parts = reader.parts(world, Transform())
    members = (*(_read_member(reader, graph, each) for each in (*world.frames, *world.joints)),)
    return WorldSurroundings(world.name, leaves, (*parts, *members), world.source)


def _read_beside_worlds(document: Document) -> WorldSurroundings:
    reader = PartReader(lambda pose, holder: holder.compose(Transform.from_pose(pose)))
    leaves, parts = reader.parts(document, Transform())
    return WorldSurroundings(_FILE, leaves, parts, document.source)


def _read_member(reader: PartReader, graph: FrameGraph, node: Frame | Joint) -> LinkPart:
    """Read a frame or joint of a world, with its pose in the world."""
    kind = "frame" if isinstance(node, Frame) else "joint"
    there = graph.pose(node.name, WORLD, kind=kind, base="world")
    opaque = tuple(part for part in node.opaque if part.name != "<pose>")  # a second one, which no reader looks at
    return reader.part(node.copy(pose=None, opaque=opaque), kind, there)


def _place_in_world(graph: FrameGraph, pose: Pose, holder: Transform) -> Transform:
    if pose.relative_to:
        holder = graph.pose(pose.relative_to, WORLD, kind="joint", base="world")
    return holder.compose(Transform.from_pose(pose))


def compare_surroundings(
    a: Mapping[str, WorldSurroundings], b: Mapping[str, WorldSurroundings], terms: Terms
) -> Iterator[Difference]:
    """Yield the differences between the worlds of two files; a note where only one file has worlds.

    If each file has a single world, the two are compared whatever their names are.
    """
    findings = ComparisonFindings(terms)
    for one, other in _pairs(a, b):
        if one is not None and other is not None:
            _compare_worlds(findings, one, other)
        elif (only := one or other) is not None:
            _report_one_sided(findings, only, in_a=one is not None, counts=bool(a and b))
    yield from findings.items


def _pairs(
    a: Mapping[str, WorldSurroundings], b: Mapping[str, WorldSurroundings]
) -> Iterable[tuple[WorldSurroundings | None, WorldSurroundings | None]]:
    lone_a, lone_b = ([each for each in found.values() if each.name] for found in (a, b))
    if len(lone_a) == len(lone_b) == 1:
        yield lone_a[0], lone_b[0]
        yield a.get(_FILE), b.get(_FILE)
        return
    for name in dict.fromkeys((*a, *b)):
        yield a.get(name), b.get(name)


def _compare_worlds(findings: ComparisonFindings, a: WorldSurroundings, b: WorldSurroundings) -> None:
    places, terms = (a.where, b.where), findings.terms
    if a.name != b.name:
        message = f"the world is called {a.name!r} in {terms.a}, and {b.name!r} in {terms.b}"
        findings.add_note(a.subject, "name", message, places)
    compare_leaves(findings, a.subject, a.leaves, b.leaves, Base(), places)
    compare_parts(findings, a.subject, a.parts, b.parts, Base())


def _report_one_sided(findings: ComparisonFindings, only: WorldSurroundings, *, in_a: bool, counts: bool) -> None:
    if counts:
        findings.add_one_sided(only.subject, "", "world", only.where, in_a=in_a)
        return
    file = findings.terms.a if in_a else findings.terms.b
    what = f"world {only.name!r}" if only.name else "what stands beside the models"
    findings.add_note(only.subject, "", f"{what} is only in {file}, and was not compared", (only.where, only.where))


@dataclass(frozen=True, slots=True)
class Robots:
    """The robots of a file by name, and the worlds around them, which are left out where one robot was chosen."""

    path: str
    format: Format
    by_name: dict[str, ComparedRobot]
    around: dict[str, WorldSurroundings]
    origins: Mapping[str, LineOrigins]
    of_mjcf: bool = False
    """Whether it is MJCF, so that what only MJCF says was read of it and is not carried along."""


def read_robots(
    source: Input | LoadResult,
    load_options: LoadOptions,
    *,
    name: str,
    model: str | None,
    readers: Iterable[ComparingReader],
    alike: Memo,
    files: dict[Path, str],
    known: frozenset[str] | None = None,
) -> dict[ComparingReader, Robots]:
    """Read the robots of a file as each reader sees them; `model` chooses one of several.

    `known` are the names of the other file, which names of USD may stand for. Readers that see the same share one
    object, and so do files through `alike`. `files` have one name for each file that relative paths of both lead to.

    Raises:
        CompileError: the file has an error, or no such model.
    """
    of_usd = is_usd(source)
    if of_usd:
        from twinform.compiler.usd import read_usd  # noqa: PLC0415 - few files are USD

        there = source if isinstance(source, bytes) else Path(str(source))
        loaded = read_usd(there, load_options, name=name, model=model, known=known)
    else:
        loaded = read(source, load_options, name=name)
    if loaded.accepted and loaded.document is not None and loaded.document.format is Format.SDF:
        from twinform.compiler.expand_includes import expand  # noqa: PLC0415 - a URDF includes nothing

        wanted = wanted_includes(loaded.document, model) if model is not None else None
        before, loaded = loaded.document, expand(loaded, load_options, wanted=wanted)
        model = name_once_expanded(before, loaded.document, model)
    document = loaded.document
    if document is None or not loaded.accepted:
        raise loaded.error()
    sink = DiagnosticSink(loaded.path, load_options.strict, origins=dict(loaded.origins))
    assets = LocalAssets(load_options.search, Path(loaded.path))
    document = named_alike(document, assets, files)
    read_before: dict[int, Robots] = {}
    found: dict[ComparingReader, Robots] = {}
    memos = defaultdict[str | None, Memo](Memo)
    for reader, seen in as_read_by(document, readers, of_mjcf=loaded.is_mjcf).items():
        if id(seen) not in read_before:
            build = partial(_build_once, memos, alike, reader, of_usd)
            robots = _robots_seen(loaded, seen, model, build, sink, assets)
            read_before[id(seen)] = replace(robots, of_mjcf=loaded.is_mjcf)
        found[reader] = read_before[id(seen)]
    return found


BuildOnce = Callable[[str | None, Model, Model, Format], ComparedRobot]
"""Builds the robot of a model by the name that it has among others, the model as the file has it, and the format."""


def _build_once(
    memos: Mapping[str | None, Memo],
    alike: Memo,
    reader: ComparingReader,
    of_usd: bool,
    name: str | None,
    model: Model,
    source: Model,
    format: Format,
) -> ComparedRobot:
    """Build a robot, or take all but its place from the other file where that says the same to the reader."""
    given, make = (model, source, format), lambda: build_robot(model, source, format, memos[name])
    return replace(alike.once((reader, name), given, make), where=model.source, of_usd=of_usd)


def _robots_seen(
    loaded: LoadResult,
    document: Document,
    model: str | None,
    build: BuildOnce,
    sink: DiagnosticSink,
    assets: Assets,
) -> Robots:
    # Both files are rewritten in the newest SDF by the passes that conversions use, and then
    # resolved in the model's frame. Compared node by node, a link frame that moved by a centimeter
    # makes every number below it another one; and an engine's numbers know nothing of colors,
    # sensors and plugins, nor of lines in the file.
    canonical = Pipeline(_to_newest_sdf(document)).with_files(assets).run(document, sink)
    canonical = without_misplaced(canonical, DiagnosticSink())
    robots: dict[str, ComparedRobot] = {}
    around: dict[str, WorldSurroundings] = {}
    try:
        if not sink.has_errors:
            robots |= _select_robots(build, document, canonical, model, sink)
        if document.format is Format.SDF and model is None and not sink.has_errors:
            around = read_surroundings(canonical)
    except FrameError as error:
        error.report(sink)
    if sink.has_errors:
        raise CompileError(tuple(sink.diagnostics))
    return Robots(loaded.path, document.format, robots, around, loaded.origins)


def _select_robots(
    build: BuildOnce,
    document: Document,
    canonical: Document,
    model: str | None,
    sink: DiagnosticSink,
) -> Iterator[tuple[str, ComparedRobot]]:
    """Yield each robot with its name, which includes the world's name where several robots have one name."""
    if document.format is Format.SDF:  # names that a model of URDF had, as far as these are unlike others
        canonical = RestoreNames.unchecked(to=Format.URDF, unique=True).run(canonical, DiagnosticSink())
    selector = Selector(canonical)
    names = list(dict.fromkeys(one.full_name for one in selector.among))
    called = Counter(one.model.name for one in selector.among)
    for name in [None] if len(names) == 1 else names if model is None else [model]:
        chosen = selector.select(name, sink)
        if sink.has_errors:
            return
        chosen = UniqueNames.unchecked().run(
            chosen, DiagnosticSink()
        )  # before 1.7 a joint and a link could share theirs
        chosen = chosen.copy(models=tuple(map(_without_additions, chosen.models)))
        source = document.models[0] if document.format is Format.URDF else chosen.models[0]
        robot = build(name, chosen.models[0], source, document.format)
        yield (robot.name if called[robot.name] == 1 or name is None else name), robot


def _without_additions(model: Model) -> Model:
    """Return the model without the masses and floating joints that conversions add because a target needs them."""
    return without_tokens(without_loose_floating(model))


def _to_newest_sdf(document: Document) -> tuple[Pass, ...]:
    newest = versions_of("sdf")[-1]
    if document.format is Format.URDF:
        return to_sdf(newest, scopes=False)
    return (FoldCapsules.unchecked(), FoldShapeMeshes.unchecked(), *raise_words(document.version))


def diff(
    a: Input,
    b: Input,
    *,
    model: str | None = None,
    tolerance: float = TOLERANCE,
    carriers: bool = False,
    **options: Unpack[FileOptions],
) -> Comparison:
    """Compare the robots in two files or documents, of either format or USD. Includes are always expanded.

    Example:
        >>> found = twinform.diff("examples/rover.urdf", "examples/four_wheels.urdf")
        >>> found.same, len(found.differences) > 10
        (False, True)

    Args:
        a: The path of a file, the bytes of one, or a document.
        b: Another one.
        model: The model to compare, where a file has several; without it those of two worlds are paired by their names.
        tolerance: The relative difference that counts as rounding; absolute for positions (m) and angles (rad).
        carriers: What only a carrier or `<gazebo>` says counts as if it were written where every reader looks, and not
            as `carried`.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.

    Raises:
        CompileError: a file has an error; what was found is in its diagnostics.
        FileNotFoundError: there is no such file; this is a CompileError too.
        TypeError: there is no such option.
        ValueError: an option has no such value.
    """
    require_options(options, FileOptions)
    load_options = LoadOptions.of(options)
    return compare_files(a, b, load_options, ComparisonOptions(tolerance, carriers), model=model)


def compare_files(
    a: Input | LoadResult,
    b: Input | LoadResult,
    load_options: LoadOptions,
    options: ComparisonOptions = USUAL,
    *,
    names: tuple[str, str] = ("", ""),
    model: str | None = None,
) -> Comparison:
    """Compare two files as `diff` does, with the options as objects; `names` are used in messages instead of paths.

    Raises:
        CompileError: a file has an error; where both have, the diagnostics are those of both.
    """
    names = (names[0] or _display_name(a, "a"), names[1] or _display_name(b, "b"))
    with garbage_collection_paused():
        readers = (ComparingReader.TWINFORM,) if options.carriers else tuple(ComparingReader)
        robots, alike, files = dict[int, dict[ComparingReader, Robots]](), Memo(), dict[Path, str]()
        errors: dict[int, CompileError] = {}
        inputs, known = (a, b), None
        # What names of USD may stand for is read first.
        for side in sorted(range(2), key=lambda side: is_usd(inputs[side])):
            try:
                robots[side] = read_robots(
                    inputs[side],
                    load_options,
                    name=names[side],
                    model=model,
                    readers=readers,
                    alike=alike,
                    files=files,
                    known=known,
                )
                known = _names_in(robots[side][readers[-1]])
            except CompileError as error:
                errors[side] = error
        if errors:
            found = tuple(diagnostic for side in sorted(errors) for diagnostic in errors[side].diagnostics)
            raise type(errors[min(errors)])(found, unreadable=any(error.unreadable for error in errors.values()))
        one, other = robots[0], robots[1]
        names = (one[readers[0]].path, other[readers[0]].path)
        tolerance = max(options.tolerance, SINGLE_PRECISION) if any(map(is_usd, inputs)) else options.tolerance
        return Comparison(*names, tolerance, tuple(_compare_for_readers(one, other, tolerance)))


def _names_in(robots: Robots) -> frozenset[str]:
    """Return the names of all links, joints and frames."""
    each = robots.by_name.values()
    return frozenset(name for robot in each for part in (robot.bodies, robot.joints, robot.frames) for name in part)


def _display_name(source: Input | LoadResult, default: str) -> str:
    name = name_of_input(source)
    return f"<{default}>" if name in {"<bytes>", "<document>"} else name


def _compare_for_readers(
    a: Mapping[ComparingReader, Robots], b: Mapping[ComparingReader, Robots], tolerance: float
) -> Iterable[Difference]:
    """Return the differences that every reader sees, and those that only some see."""
    first, *more = a
    pair = a[first], b[first]
    memos = defaultdict[str, Memo](Memo)
    found = list(_compare_for_reader(*pair, tolerance, memos))
    for reader in more:
        seen = a[reader], b[reader]
        # What two readers see alike is built and compared once: asking for every reader costs
        # little where carriers touch little.
        if seen[0] is not pair[0] or seen[1] is not pair[1]:
            files = pair[0].path, pair[1].path
            found = reconcile(found, list(_compare_for_reader(*seen, tolerance, memos)), reader, files)
        pair = seen
    return found


def _compare_for_reader(a: Robots, b: Robots, tolerance: float, memos: Mapping[str, Memo]) -> Iterator[Difference]:
    """Yield the differences that one reader sees; `memos` have the last results for each pair of robots."""
    of_mjcf = a.of_mjcf and b.of_mjcf
    terms = Terms(a.path, b.path, a.format, b.format, tolerance, {**a.origins, **b.origins}, of_mjcf)
    yield from compare_surroundings(a.around, b.around, terms)
    if len(a.by_name) == len(b.by_name) == 1:
        (one,), (other,) = a.by_name.values(), b.by_name.values()
        yield from _compare_pair(one, other, terms, memos[""])
        return
    for name, robot in a.by_name.items():
        if name in b.by_name:
            yield from _compare_pair(robot, b.by_name[name], terms, memos[name], several=True)
        else:
            yield from _report_missing(robot, terms, in_a=True)
    for name, robot in b.by_name.items():
        if name not in a.by_name:
            yield from _report_missing(robot, terms, in_a=False)


def _compare_pair(
    a: ComparedRobot, b: ComparedRobot, terms: Terms, memo: Memo, *, several: bool = False
) -> Iterable[Difference]:
    if a.bodies is b.bodies:  # made once for both files
        return ()
    from twinform.compiler.compare.compare_robots import RobotComparison  # noqa: PLC0415 - for robots that differ

    return memo.once("robot", (a, b), lambda: RobotComparison(a, b, terms, memo, several=several).run())


def _report_missing(robot: ComparedRobot, terms: Terms, *, in_a: bool) -> list[Difference]:
    found = ComparisonFindings(terms)
    found.add_one_sided(ComparedSubject("model", robot.name), "", "model", robot.where, in_a=in_a)
    return found.items
