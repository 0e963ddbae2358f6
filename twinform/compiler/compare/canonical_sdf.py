"""The robots of a URDF or SDF file in the syntax of the newest SDF version, in which they are compared."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from twinform.compiler.compare.compared_robot import ComparedRobot
from twinform.compiler.compare.memo import Memo
from twinform.compiler.compare.readers import ComparingReader, as_read_by
from twinform.compiler.compare.robot_builder import build_robot
from twinform.compiler.compare.surroundings import WorldSurroundings, read_surroundings
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.includes.expanding import expand
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, read
from twinform.compiler.search.resolve_uris import LocalAssets
from twinform.diagnostics import DiagnosticSink, LineOrigins
from twinform.ir import Document, Format, Model
from twinform.ir.frames import FrameError
from twinform.passes import Assets, Pass, Pipeline
from twinform.passes.carriers.misplaced import without_misplaced
from twinform.passes.carriers.token_mass import without_tokens
from twinform.passes.legalise.changed_names import RestoreNames
from twinform.passes.legalise.to_sdf import to_sdf
from twinform.passes.legalise.to_sdf.unique_names import UniqueNames
from twinform.passes.legalise.to_urdf.restore_links import without_loose_floating
from twinform.passes.legalise.to_urdf.select_model import Selector
from twinform.passes.sdf_versions import raise_words
from twinform.passes.shared.candidates import name_once_expanded, wanted_includes
from twinform.schemas import versions_of


@dataclass(frozen=True, slots=True)
class Robots:
    """The robots of a file by their names, and what is around them; nothing where one of them was chosen."""

    path: str
    format: Format
    by_name: dict[str, ComparedRobot]
    around: dict[str, WorldSurroundings]
    origins: Mapping[str, LineOrigins]


def read_robots(
    source: Input | LoadResult,
    load_options: LoadOptions,
    *,
    name: str,
    model: str | None,
    readers: Iterable[ComparingReader],
) -> dict[ComparingReader, Robots]:
    """The robots of a file as each reader sees them; where there are several and `model` names one, that one.

    What two readers see alike is one object.

    Raises:
        CompileError: the file has an error, or no such model.
    """
    loaded = read(source, load_options, name=name)
    if loaded.accepted:
        wanted = wanted_includes(loaded.document, model) if model is not None else None
        before, loaded = loaded.document, expand(loaded, load_options, wanted=wanted)
        model = name_once_expanded(before, loaded.document, model)
    document = loaded.document
    if document is None or not loaded.accepted:
        raise CompileError(loaded.diagnostics, unreadable=loaded.unreadable)
    sink = DiagnosticSink(loaded.path, load_options.strict, origins=dict(loaded.origins))
    assets = LocalAssets(load_options.search, Path(loaded.path))
    known: dict[int, Robots] = {}
    found: dict[ComparingReader, Robots] = {}
    memos = defaultdict[str | None, Memo](Memo)
    for reader, seen in as_read_by(document, readers).items():
        if id(seen) not in known:
            known[id(seen)] = _robots_seen(loaded, seen, model, memos, sink, assets)
        found[reader] = known[id(seen)]
    return found


def _robots_seen(
    loaded: LoadResult,
    document: Document,
    model: str | None,
    memos: Mapping[str | None, Memo],
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
            robots |= _robots(memos, document, canonical, model, sink)
        if document.format is Format.SDF and model is None and not sink.has_errors:
            around = read_surroundings(canonical)
    except FrameError as error:
        error.report(sink)
    if sink.has_errors:
        raise CompileError(tuple(sink.diagnostics))
    return Robots(loaded.path, document.format, robots, around, loaded.origins)


def _robots(
    memos: Mapping[str | None, Memo],
    document: Document,
    canonical: Document,
    model: str | None,
    sink: DiagnosticSink,
) -> Iterator[tuple[str, ComparedRobot]]:
    """Each robot by its name, with its world's where several are called so."""
    if document.format is Format.SDF:  # names that a model of URDF had, as far as these are unlike others
        canonical = RestoreNames(to=Format.URDF, unique=True).run(canonical, DiagnosticSink())
    selector = Selector(canonical)
    names = list(dict.fromkeys(one.full_name for one in selector.among))
    called = Counter(one.model.name for one in selector.among)
    for name in [None] if len(names) == 1 else names if model is None else [model]:
        chosen = selector.select(name, sink)
        if sink.has_errors:
            return
        chosen = UniqueNames().run(chosen, DiagnosticSink())  # before 1.7 a joint and a link could share theirs
        chosen = chosen.copy(models=tuple(map(_comparable, chosen.models)))
        source = document.models[0] if document.format is Format.URDF else chosen.models[0]
        robot = build_robot(chosen.models[0], source, document.format, memos[name])
        yield (robot.name if called[robot.name] == 1 or name is None else name), robot


def _comparable(model: Model) -> Model:
    """The model without what conversions put there because a target cannot do without."""
    return without_tokens(without_loose_floating(model))


def _to_newest_sdf(document: Document) -> tuple[Pass, ...]:
    newest = versions_of("sdf")[-1]
    if document.format is Format.URDF:
        return to_sdf(newest, carriers=True, scopes=False)
    return raise_words(document.version)
