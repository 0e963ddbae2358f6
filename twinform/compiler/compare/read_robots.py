"""Reads the robots of a file to compare them: rewritten in the newest SDF version, and as each reader sees them."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from twinform.compiler.compare.compared_robot import ComparedRobot
from twinform.compiler.compare.readers import ComparingReader, Memo, as_read_by
from twinform.compiler.compare.robot_builder import build_robot
from twinform.compiler.compare.surroundings import WorldSurroundings, read_surroundings
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.loading import (
    Input,
    LoadOptions,
    LoadResult,
    is_usd,
    read,
)
from twinform.compiler.moved_paths import named_alike
from twinform.compiler.resolve_uris import LocalAssets
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, LineOrigins
from twinform.ir import Document, Format, Model
from twinform.ir.frames import FrameError
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
