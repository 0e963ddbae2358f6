"""Splits a world: a file for each of its models, and one that includes them.

Models become URDF where Gazebo reads that as the same robot. Gazebo reads an included URDF with a converter of its own,
which would refuse, leave out or rename what `changes_in_gazebo` lists: a model with any of it stays SDF, and a warning
gives the reason.

libsdformat lumps links that are fixed to each other, and leaves out links that then have no mass, with all that hangs
from them. It refuses a floating joint unless a frame in `<gazebo>` has its name. The rules are those of its
`parser_urdf.cc`, tried on libsdformat 12 and 17.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import field, replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.conversion import has_mixed_words, mixed_words, written
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.expand_includes import OtherDocuments, expand
from twinform.compiler.input.loading import Input, LoadOptions, garbage_collection_paused, read
from twinform.compiler.input.take_comments import comments_of
from twinform.compiler.moved_paths import moved
from twinform.compiler.other_xacro import assets_of
from twinform.compiler.output.emitting import emit_legal
from twinform.compiler.output.source_comments import Comments
from twinform.compiler.request import ConversionRequest
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Ledger, Location, SideFile, rules
from twinform.diagnostics.rules import UNSAYABLE_SHAPE
from twinform.ir import Capsule, Document, Element, Format, Include, Model, Pose, World
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.scopes import SCOPE, outer_models
from twinform.ir.transform import Transform
from twinform.ir.verify import verify
from twinform.lazy import lazy_pattern
from twinform.passes import PassInstrumentation
from twinform.passes.includes import detach, links_named_around
from twinform.passes.shared.gazebo_tags import lumped_links
from twinform.schemas import XmlElement, table

_UNSAFE = lazy_pattern(r"[^A-Za-z0-9._-]+")
"""Characters that some file system or shell does not take in a name."""

# Files in which libsdformat describes SDF to itself; it would take an include of such a name for
# these.
_OF_LIBSDFORMAT = frozenset(f"{name}.sdf" for name in ("root", "urdf", *table("sdf").definitions))


@dataclass(frozen=True, slots=True)
class SplitWorld:
    """The texts of the files by name, the last of which includes the others, and what was found and lost on the way.

    `side_files` are files that passes have made beside them.
    """

    files: Mapping[str, str]
    diagnostics: tuple[Diagnostic, ...]
    ledger: Ledger
    side_files: tuple[SideFile, ...] = ()


@dataclass(frozen=True, slots=True)
class Placement:
    """Where the files of a world go: a file's name gives its URI in the world, and its document may be adapted."""

    uri: Callable[[str], str] = str
    adapted: Callable[[Document, str, DiagnosticSink], Document] = lambda document, _file, _sink: document


_BESIDE = Placement()
"""All files in one folder."""


def split(
    request: ConversionRequest,
    source: Input,
    load_options: LoadOptions,
    *,
    name: str = "",
    instrumentation: PassInstrumentation | None = None,
    folder: Path | None = None,
    placement: Placement = _BESIDE,
) -> SplitWorld:
    """Write every model of an SDF file into a file of its own, and the rest, with includes, under the file's name.

    Models become URDF where Gazebo reads that as the same robot, or stay SDF if SDF is requested. `folder` is where the
    files go: relative paths are rewritten to lead from there to the same files, and stay as they are without it.
    `placement` is for files that go to several folders.

    Raises:
        CompileError: the source, a pass or one of the results has an error.
    """
    with garbage_collection_paused():
        load_options = load_options.read_by(request.sdf_version)
        checked = read(source, replace(load_options, keep_comments=request.comments), name=name)
        if request.expand_includes:
            checked = expand(checked, load_options, carriers=request.carriers)
        elif request.to == "urdf":
            whole = expand(checked, load_options, wanted=_inside_models(checked.document), carriers=request.carriers)
            checked = whole if whole.accepted else checked  # a model with includes in it stays SDF
        if checked.document is None or not checked.accepted:
            raise checked.error()
        sink = checked.sink(strict=load_options.strict)
        assets = assets_of(checked.path, load_options)
        request = replace(request, assets=assets, mixed=has_mixed_words(checked))
        passes = request.passes.with_files(request.assets, OtherDocuments(load_options, checked.path).read)
        document = passes.run(checked.document, sink, instrumentation, verify)
        if document.format is not Format.SDF:
            message = "the file is URDF, which holds one robot; --split is for SDF"
            sink.report(rules.INVALID_VALUE, message, document.location, found="urdf", expected="sdf")
        if folder is not None:
            # Before the passes that a target asks for, which look up what they need by the old
            # paths; what they make of a path is then made of the new one.
            document, there = moved(document, assets, folder, sink)
            request = replace(request, assets=there)
        kept = mixed_words(checked) if checked.mixed else None
        comments = comments_of(checked, document, "sdf", None)
        files = _SplitFiles(request, sink, instrumentation, kept, _name_of_world(checked.path), comments, placement)
        if not sink.has_errors:
            files.add(document)
        if sink.has_errors:
            raise CompileError(tuple(sink.diagnostics))
        lost = sum(entry.weight for entry in sink.entries)
        ledger = Ledger(max(0, checked.size - lost), tuple(sink.entries))
        return SplitWorld(files.texts, tuple(sink.diagnostics), ledger, tuple(sink.side_files))


def _inside_models(document: Document | None) -> Callable[[Include], bool]:
    """Tell which includes are inside of models: a robot is one file, and other includes stay."""
    places = (document, *document.worlds) if document else ()
    outermost = {id(include) for place in places for include in place.includes}
    return lambda include: id(include) not in outermost


@dataclass(frozen=True, slots=True)
class _Urdf:
    """A model as URDF: its text, its root link and where that is in the frame of the model, and its diagnostics."""

    text: str
    root_name: str
    root: Transform
    sink: DiagnosticSink


@dataclass(slots=True)
class _SplitFiles:
    """Makes the files of one split.

    `name` is the name of the file around the models. Where the document was put together from several files, `kept`
    are the elements of these files that the document's version does not have.
    """

    request: ConversionRequest
    sink: DiagnosticSink
    instrumentation: PassInstrumentation | None
    kept: frozenset[str] | None
    name: str
    comments: Comments | None
    placement: Placement
    texts: dict[str, str] = field(default_factory=dict[str, str])
    urdf: dict[int, _Urdf] = field(default_factory=dict[int, _Urdf])
    """The models that become URDF, by their identity."""

    def add(self, document: Document) -> None:
        """Add the whole document: its models first, so that the rest can name their files."""
        worlds: list[World] = []
        for world in document.worlds:
            self._convert_to_urdf(document, world.models, links_named_around(world))
            apart = detach(world, dict(self._urdf_frames(world.models)), self.sink)
            placed = zip(world.models, apart.models, strict=True)
            includes = tuple(self._include(document, model, now.pose) for model, now in placed)
            worlds.append(apart.copy(models=(), includes=(*apart.includes, *includes)))
        self._convert_to_urdf(document, document.models, {})
        includes = (*document.includes, *(self._include(document, each, each.pose) for each in document.models))
        rest = document.copy(worlds=tuple(worlds), models=(), includes=includes)
        around = self._comments_around(tuple(outer_models(document)))
        self.texts[self.name] = self._sdf_text(rest, self.name, around)

    def _urdf_frames(self, models: tuple[Model, ...]) -> Iterator[tuple[str, str]]:
        """Yield each model in URDF with the frame that is where the model was: its own, or that of its root link."""
        for model in models:
            made = self.urdf.get(id(model))
            if made is not None:
                yield model.name, model.name if made.root.is_identity else f"{model.name}::{made.root_name}"

    def _convert_to_urdf(
        self, document: Document, models: tuple[Model, ...], named: Mapping[str, frozenset[str]]
    ) -> None:
        """Make URDF of models that stay the same robots in Gazebo, and report why others stay SDF."""
        for model in models if self.request.to == "urdf" else ():
            made, why = self._as_urdf(document, model, named.get(model.name, frozenset()))
            if made is None:
                message = f"model {model.name!r} stays SDF: {why}"
                self.sink.report(rules.KEPT_AS_SDF, message, model.location, found=model.name)
                continue
            self.urdf[id(model)] = made
            self.sink.extend(made.sink.diagnostics)
            self.sink.entries.extend(made.sink.entries)

    def _as_urdf(self, document: Document, model: Model, named: frozenset[str]) -> tuple[_Urdf | None, str]:
        """Return a model as URDF, or the reason why it cannot be."""
        # libsdformat places the root link of an included URDF where the include says, and not the
        # frame of the model. So the pose stands in the include, for the root.
        alone = _document_of(document, model.copy(pose=None, placement_frame=None))
        sink = DiagnosticSink(self.sink.file, self.sink.strict, origins=self.sink.origins, allows=self.sink.allows)
        comments = self._comments_in(model, foreign=True)
        made, text = emit_legal(alone, self.request.legalisation(alone), sink, self.instrumentation, comments=comments)
        wrong = [each for each in sink.diagnostics if each.is_error or each.rule is UNSAYABLE_SHAPE]
        if wrong:
            return None, wrong[0].message
        first = next(changes_in_gazebo(model, made.models[0], named), None)
        if first is not None:
            return None, first.what
        root = _root_link(made.models[0])
        try:
            place = Transform() if root == WORLD else FrameGraph(model).pose(root, MODEL, kind="link", base="model")
        except FrameError:
            return None, f"its root would be {root!r}, which it does not have"
        return _Urdf(text, root, place, sink), ""

    def _include(self, document: Document, model: Model, pose: Pose | None) -> Include:
        """Write the file of a model, and return the include that stands in its place."""
        made = self.urdf.get(id(model))
        file = self._free_file_name(model.name, "sdf" if made is None else "urdf")
        if made is None:
            alone = _document_of(document, model.copy(pose=None))
            self.texts[file] = self._sdf_text(alone, file, self._comments_in(model))
            pose = pose or (Pose() if model.placement_frame else None)  # its frame is in the file, and its pose is here
            return Include(uri=self.placement.uri(file), name=model.name, pose=pose, source=model.source)
        self.texts[file] = made.text
        placed = _pose_of_root(model, pose, made.root, self.sink)
        uri = self.placement.uri(file)
        return Include(uri=uri, name=model.name, pose=placed, static=model.static, source=model.source)

    def _sdf_text(self, document: Document, file: str, comments: Comments | None) -> str:
        """Return the text of a document that stays SDF, in the requested version."""
        document = self.placement.adapted(document, file, self.sink)
        request = replace(self.request, to="sdf")
        return written(document, request, self.sink, self.instrumentation, kept=self.kept, comments=comments)[1]

    def _comments_in(self, model: Model, *, foreign: bool = False) -> Comments | None:
        """Return the comments in a model, which go into its file."""
        inside = self._element(model)
        if self.comments is None or inside is None:
            return None
        return replace(self.comments, partial=True, foreign=foreign, inside=inside)

    def _comments_around(self, models: Iterable[Model]) -> Comments | None:
        """Return the comments outside of models."""
        if self.comments is None:
            return None
        return replace(
            self.comments, outside=frozenset(found for each in models if (found := self._element(each)) is not None)
        )

    def _element(self, model: Model) -> XmlElement | None:
        return self.comments.element(model.source) if self.comments and model.source else None

    def _free_file_name(self, model: str, suffix: str) -> str:
        """Return a new file name that every system takes, different from the others even where case does not count."""
        base = _UNSAFE.sub("_", model).strip(".") or "model"
        taken = {name.lower() for name in (self.name, *self.texts)}
        name, number = f"{base}.{suffix}", 1
        while name.lower() in taken or name.lower() in _OF_LIBSDFORMAT:
            name, number = f"{base}_{number}.{suffix}", number + 1
        return name


def _document_of(document: Document, model: Model) -> Document:
    return document.copy(models=(model,), worlds=(), lights=(), includes=(), opaque=())


def _root_link(robot: Model) -> str:
    children = {joint.child for joint in robot.joints}
    return next(link.name for link in robot.links if link.name not in children)


def _pose_of_root(model: Model, pose: Pose | None, root: Transform, sink: DiagnosticSink) -> Pose | None:
    """Return the pose of a model's root link, the frame of its URDF, without naming frames inside the model."""
    place = Transform.from_pose(pose)
    if model.placement_frame:
        try:
            placement = FrameGraph(model).pose(model.placement_frame, MODEL, kind="frame", base="model")
        except FrameError as error:
            error.report(sink)
            return pose
        place = place.compose(placement.inverse())
    elif root.is_identity:
        return pose
    made = place.compose(root).to_pose(pose.relative_to if pose else None)
    return None if made == Pose() else made


def _name_of_world(path: str) -> str:
    """Return the name of the file with the world: the source's without further endings, or else `world.sdf`."""
    name, _, endings = Path(path).name.partition(".")
    if not name or name.startswith("<"):
        return "world.sdf"
    return f"{name}.world" if "world" in endings.lower().split(".") else f"{name}.sdf"


# libsdformat 12 saw another world in 41 of 76 files of a sample of the corpus, and refused five
# more, when every model became URDF. What would be another robot stays SDF: to refuse the world
# would help nobody with a ground plane, and to write both forms would make two truths. `make report
# NAME=worlds` holds this list against libsdformat.
NO_MASS = 1e-6
"""Links that weigh no more, in kg, have no mass for libsdformat before 13."""
_SHARED = frozenset({"fixed", "revolute", "continuous", "prismatic"})
"""Types of joints that are one joint in both formats."""


class GazeboChange(NamedTuple):
    """A change that Gazebo would make to a part of the robot, as text, and where the part is in the source."""

    what: str
    location: Location


def changes_in_gazebo(original: Model, made: Model, named: AbstractSet[str] = frozenset()) -> Iterator[GazeboChange]:
    """Yield what would change if Gazebo read the URDF `made` instead of the SDF `original`.

    `named` are the links that parts outside of the model name.
    """
    for inner in original.models:
        yield GazeboChange(f"the parts of the model {inner.name!r} in it would have other names", inner.location)
    for include in original.includes:
        yield GazeboChange(f"it includes {include.uri!r}, which cannot be put in its place", include.location)
    for part in (*original.links, *original.joints):
        if SCOPE in part.name:
            yield GazeboChange(f"URDF cannot have the name {part.name!r}", part.location)
    yield from _shape_changes(made)
    yield from _name_changes(made)
    for joint in original.joints:
        if joint.type not in _SHARED:
            yield GazeboChange(f"{joint.type} joint {joint.name!r} would not be one for Gazebo", joint.location)
    frames = {frame.get("name") for frame in _in_extensions(made, "frame")}
    for joint in made.joints:
        if joint.type == "planar" or (joint.type == "floating" and joint.name not in frames):
            yield GazeboChange(
                f"Gazebo refuses URDF with a {joint.type} joint, which holds {joint.child!r}", joint.location
            )
    yield from _mass_changes(made, named)


def _shape_changes(made: Model) -> Iterator[GazeboChange]:
    for link in made.links:
        for shape in (*link.visuals, *link.collisions):
            if shape.geometry and isinstance(shape.geometry.shape, Capsule):
                yield GazeboChange(f"Gazebo reads no capsule from URDF, as link {link.name!r} has it", shape.location)


def _name_changes(made: Model) -> Iterator[GazeboChange]:
    links = {link.name for link in made.links}
    for joint in made.joints:
        if joint.name in links:
            yield GazeboChange(
                f"a joint and a link are called {joint.name!r}, which Gazebo refuses in URDF", joint.location
            )


def _mass_changes(made: Model, named: AbstractSet[str]) -> Iterator[GazeboChange]:
    """Yield links that are left out because they have no mass, and named links that are merged into others."""
    hosts = lumped_links(made)
    weights: dict[str, float] = defaultdict(float)
    for link in made.links:
        weights[hosts[link.name]] += (link.inertial and link.inertial.mass) or 0.0
    for link in made.links:
        if hosts[link.name] == link.name != WORLD and weights[link.name] <= NO_MASS:
            what = f"Gazebo leaves link {link.name!r}, which has no mass, out of URDF, with all that hangs from it"
            yield GazeboChange(what, link.location)
    outside = {*named, *_named_in_extensions(made)}
    for link in made.links:
        if hosts[link.name] != link.name and link.name in outside:
            what = f"link {link.name!r}, which a joint names, would go into {hosts[link.name]!r}"
            yield GazeboChange(what, link.location)


def _named_in_extensions(made: Model) -> Iterator[str]:
    """Yield the parent and child links of joints in `<gazebo>` elements."""
    for joint in _in_extensions(made, "joint"):
        yield from (end.text for end in joint.children if end.name in {"parent", "child"} and end.text)


def _in_extensions(made: Model, name: str) -> Iterator[Element]:
    """Yield the elements of a name in `<gazebo>`."""
    for block in made.extensions:
        yield from (element for element in block.content if element.name == name)
