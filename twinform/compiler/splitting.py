"""A world as a URDF file for each of its models and an SDF file that includes them."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from twinform.compiler.emitting import emit, emit_legal
from twinform.compiler.errors import CompileError
from twinform.compiler.includes import expand
from twinform.compiler.loading import Reading, garbage_collection_paused, read
from twinform.compiler.orders import Order
from twinform.compiler.other_documents import OtherDocuments
from twinform.compiler.uris import LocalAssets
from twinform.diagnostics import Companion, Diagnostic, Ledger, Notes
from twinform.diagnostics.rules import structure
from twinform.ir import Document, Format, Include, Model, World
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.ir.verify import verify
from twinform.passes import Watch
from twinform.passes.includes import detach

_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
"""What some file system or shell would not take in a name."""


@dataclass(frozen=True, slots=True)
class Split:
    """The text of each file by its name, what was found and lost on the way, and the files that passes made beside."""

    files: Mapping[str, str]
    diagnostics: tuple[Diagnostic, ...]
    ledger: Ledger
    companions: tuple[Companion, ...] = ()


def split(
    order: Order,
    source: str | Path | bytes,
    how: Reading,
    *,
    name: str = "",
    watch: Watch | None = None,
) -> Split:
    """Every model of an SDF file as URDF, and the file with includes in their place under the name of the source.

    Raises:
        CompileError: the source, a pass or one of the results has an error.
    """
    with garbage_collection_paused():
        checked = read(source, how, name=name)
        wanted = None if order.expand_includes else _inside_models(checked.document)
        checked = expand(checked, how, wanted=wanted, carriers=order.carriers)
        if checked.document is None or not checked.accepted:
            raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
        notes = Notes(
            checked.path, how.strict, list(checked.diagnostics), list(checked.entries), origins=dict(checked.origins)
        )
        order = replace(order, assets=LocalAssets(how.search, Path(checked.path)))
        passes = order.passes.with_files(order.assets, OtherDocuments(how, checked.path).read)
        document = passes.run(checked.document, notes, watch, verify)
        files = _Files(order, notes, watch)
        if document.format is not Format.SDF:
            message = "the file is URDF, which holds one robot; --split is for SDF"
            notes.report(structure.INVALID_VALUE, message, document.location, found="urdf", expected="sdf")
        elif not notes.has_errors:
            files.add(document, _stem(checked.path))
        if notes.has_errors:
            raise CompileError(tuple(notes.diagnostics))
        lost = sum(entry.weight for entry in notes.entries)
        ledger = Ledger(max(0, checked.size - lost), tuple(notes.entries))
        return Split(files.texts, tuple(notes.diagnostics), ledger, tuple(notes.companions))


def _inside_models(document: Document | None) -> Callable[[Include], bool]:
    """Includes of worlds and of the root stay; a robot is one file, with all that is in it."""
    places = (document, *document.worlds) if document else ()
    outermost = {id(include) for place in places for include in place.includes}
    return lambda include: id(include) not in outermost


@dataclass(slots=True)
class _Files:
    """The files of one split."""

    order: Order
    notes: Notes
    watch: Watch | None
    texts: dict[str, str] = field(default_factory=dict[str, str])

    def add(self, document: Document, stem: str) -> None:
        """The whole document: the models first, so that the rest can name their files."""
        worlds: list[World] = []
        for world in document.worlds:
            world = detach(world, self.notes)  # noqa: PLW2901 - the same world in other words
            includes = tuple(self._robots(document, world.models))
            worlds.append(world.model_copy(update={"models": (), "includes": (*world.includes, *includes)}))
        includes = (*document.includes, *self._robots(document, document.models))
        rest = document.model_copy(update={"worlds": tuple(worlds), "models": (), "includes": includes})
        self.texts[f"{stem}.sdf"] = emit(rest, self.notes)

    def _robots(self, document: Document, models: tuple[Model, ...]) -> Iterator[Include]:
        for model in models:
            file = self._name(model.name)
            include = _include(model, file, self.notes)
            alone = model.model_copy(update={"pose": None, "placement_frame": None})
            self.texts[file] = self._urdf(document, alone)
            yield include

    def _urdf(self, document: Document, model: Model) -> str:
        alone = document.model_copy(
            update={"models": (model,), "worlds": (), "lights": (), "includes": (), "opaque": ()}
        )
        notes = Notes(self.notes.file, self.notes.strict, origins=self.notes.origins)
        _, text = emit_legal(alone, self.order.legalisation(alone), notes, self.watch)
        self.notes.extend(notes.diagnostics)
        self.notes.entries.extend(notes.entries)
        return text

    def _name(self, model: str) -> str:
        """A file name that every system takes, unlike the others even where case does not count."""
        base = _UNSAFE.sub("_", model).strip(".") or "model"
        taken = {name.lower() for name in self.texts}
        name, number = f"{base}.urdf", 1
        while name.lower() in taken:
            name, number = f"{base}_{number}.urdf", number + 1
        return name


def _include(model: Model, file: str, notes: Notes) -> Include:
    """What stands in the place of a model: where it was, in terms that do not need the frames inside it."""
    pose = model.pose
    if model.placement_frame:
        try:
            placement = FrameGraph(model).pose(model.placement_frame, MODEL, kind="frame", base="model")
            base = pose.relative_to if pose else None
            pose = Transform.from_pose(pose).compose(placement.inverse()).to_pose(base)
        except FrameError as error:
            error.report(notes)
    return Include(uri=file, name=model.name, pose=pose, static=model.static, source=model.source)


def _stem(path: str) -> str:
    """The name of the source without its endings; that of what is no file is `world`."""
    name = Path(path).name.partition(".")[0]
    return name if name and not name.startswith("<") else "world"
