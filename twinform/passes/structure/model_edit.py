"""Base class of the passes on structure: every model of a document, or the one that is named."""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Model, World, replace_fields
from twinform.ir.frames import FrameError
from twinform.ir.scopes import outer_models
from twinform.passes.framework.pass_base import Pass
from twinform.schemas import parse_version, versions_of

FRAMES_EVERYWHERE = "1.8"
"""The first version of SDF in which joints connect any two frames, and poses may be in any."""


@dataclass(frozen=True, slots=True)
class EditContext:
    """What a model is in, and where to write what is found."""

    format: Format
    sink: DiagnosticSink


class ModelEdit(Pass):
    """A pass over the models at the root and in worlds; `model` names the only one that is changed."""

    model: str | None = Field(default=None, description="The only model to change; otherwise all of them.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with its models passed through; SDF of a version before 1.8 is raised to it."""
        return self.edit(document, sink)

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with its models passed through; the one that came in where nothing changes."""
        if not _has_model(document, self.model):
            message = f"there is no model {self.model!r}"
            sink.report(rules.UNKNOWN_NAME, message, document.location, found=self.model)
            return document
        return in_new_words(document, sink, lambda modern: self._each(modern, sink))

    def _each(self, document: Document, sink: DiagnosticSink) -> Document:
        place = EditContext(document.format, sink)
        models = tuple(self._one(model, place) for model in document.models)
        worlds = tuple(self._world(world, document, sink) for world in document.worlds)
        return replace_fields(document, models=models, worlds=worlds)

    def _world(self, world: World, document: Document, sink: DiagnosticSink) -> World:
        place = EditContext(document.format, sink)
        made = replace_fields(world, models=tuple(self._one(model, place) for model in world.models))
        return world if made is world else self.in_world(world, made)

    def _one(self, model: Model, place: EditContext) -> Model:
        return self.edit_model(model, place) if self.model in (None, model.name) else model

    def in_world(self, before: World, after: World) -> World:
        """The world after its models have changed; for passes that have to tell the world."""
        del before
        return after

    @abstractmethod
    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model after the pass; the one that came in where nothing changes."""


def _has_model(document: Document, name: str | None) -> bool:
    return name is None or any(model.name == name for model in outer_models(document))


def in_new_words(document: Document, sink: DiagnosticSink, change: Callable[[Document], Document]) -> Document:
    """A document after a change that is made in the syntax of SDF 1.8; the one that came in where that changes nothing.

    URDF, and SDF that is newer, is changed as it is. What raising the version reports is reported only after a change.
    """
    own = DiagnosticSink(sink.file, sink.strict, origins=sink.origins)
    modern = _modern(document, own)
    if own.has_errors:
        sink.extend(own.diagnostics)
        return document
    try:
        made = change(modern)
    except FrameError as error:
        error.report(sink)
        return document
    if made is modern:
        return document
    sink.extend_new(own.diagnostics)
    sink.entries.extend(own.entries)
    return made


def _modern(document: Document, sink: DiagnosticSink) -> Document:
    """A document of SDF before 1.8 in the syntax of 1.8; any other as it is."""
    known, version = versions_of("sdf"), document.version
    if document.format is not Format.SDF or version not in known:
        return document
    if parse_version(version) >= parse_version(FRAMES_EVERYWHERE):
        return document
    from twinform.passes.sdf_versions import change_version  # noqa: PLC0415 - few files need all the steps

    for step in change_version(version, FRAMES_EVERYWHERE):
        document = step.run(document, sink)
    message = f"the file is SDF {version}; the result is SDF {FRAMES_EVERYWHERE}"
    sink.report(rules.RAISED_VERSION, message, document.location, found=version)
    return document
