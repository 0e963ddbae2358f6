"""The base class of passes on structure, which change every model of a document or the one that is named."""

from abc import abstractmethod
from collections.abc import Callable

from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Model, World, replace_fields
from twinform.ir.frames import FrameError
from twinform.ir.scopes import outer_models
from twinform.passes.framework.pass_base import Pass
from twinform.schemas import parse_version, versions_of

FRAMES_EVERYWHERE = "1.8"
"""The first version of SDF in which joints connect any two frames, and poses may be relative to any frame."""


@dataclass(frozen=True, slots=True)
class EditContext:
    """The format of the document that a model is in, and the sink for findings."""

    format: Format
    sink: DiagnosticSink


class ModelEdit(Pass):
    """A pass that changes the models at the root and in worlds; `model` names the only one that is changed."""

    model: str | None = Field(default=None, description="The only model to change; otherwise all of them.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with changed models; SDF before version 1.8 is raised to that version."""
        return self.edit(document, sink)

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with changed models; the same document where nothing changes."""
        if not _has_model(document, self.model):
            message = f"there is no model {self.model!r}"
            sink.report(rules.UNKNOWN_NAME, message, document.location, found=self.model)
            return document
        return edit_in_modern_sdf(document, sink, lambda modern: self._edit_models(modern, sink))

    def _edit_models(self, document: Document, sink: DiagnosticSink) -> Document:
        place = EditContext(document.format, sink)
        models = tuple(self._edit_if_named(model, place) for model in document.models)
        worlds = tuple(self._edit_world(world, document, sink) for world in document.worlds)
        return replace_fields(document, models=models, worlds=worlds)

    def _edit_world(self, world: World, document: Document, sink: DiagnosticSink) -> World:
        place = EditContext(document.format, sink)
        made = replace_fields(world, models=tuple(self._edit_if_named(model, place) for model in world.models))
        return world if made is world else self.update_world(world, made)

    def _edit_if_named(self, model: Model, place: EditContext) -> Model:
        return self.edit_model(model, place) if self.model in (None, model.name) else model

    def update_world(self, before: World, after: World) -> World:
        """The world after its models have changed; a pass may let references in the world follow."""
        del before
        return after

    @abstractmethod
    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model after the pass; the same model where nothing changes."""


def _has_model(document: Document, name: str | None) -> bool:
    return name is None or any(model.name == name for model in outer_models(document))


def edit_in_modern_sdf(document: Document, sink: DiagnosticSink, change: Callable[[Document], Document]) -> Document:
    """The document after a change in the syntax of SDF 1.8; the same document where nothing changes.

    URDF and newer SDF are changed as they are. Findings about the raised version are reported only after a change.
    """
    own = DiagnosticSink(sink.file, sink.strict, origins=sink.origins)
    modern = _modernize(document, own)
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


def _modernize(document: Document, sink: DiagnosticSink) -> Document:
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
