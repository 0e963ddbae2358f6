"""Replacing the includes of a document by the models of other files."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Include, Model, World, replace_fields
from twinform.ir.element import joined
from twinform.ir.scopes import nested_includes, outer_models
from twinform.ir.transform import Transform
from twinform.passes.includes.merge import merge_into_model, merge_into_world
from twinform.passes.includes.place import account_replaced, placed_actor, placed_light, placed_model, report_leftovers
from twinform.passes.includes.relocate import relocate
from twinform.passes.includes.upgrade import newest, upgrade_document

Holder = TypeVar("Holder", Document, World)

_NESTED_MODELS = "1.5"
_NAMED_FRAMES = "1.7"
"""The versions of SDF since which there are these."""


@dataclass(frozen=True, slots=True)
class Included:
    """The document that an include names, itself expanded, and the URI of the folder that it lies in.

    `frame` is that of its model in the one that the include places: for URDF that is the root link, whatever frame the
    model had in the SDF that it was converted from.
    """

    document: Document
    folder: str
    frame: Transform = field(default_factory=Transform)


Resolver = Callable[[Include], Included | None]
"""Gives the document of an include; None leaves the include where it is."""


def has_includes(document: Document) -> bool:
    """Whether there is any include in a document."""
    return any(_includes(document))


def expand_includes(document: Document, resolve: Resolver, sink: DiagnosticSink, *, carriers: bool = True) -> Document:
    """The document with what its includes name in their place.

    Files of different versions come together in the newest of them: older ones are upgraded to it, and what it
    lacks is carried, or dropped without `carriers`.
    """
    found = [resolve(include) for include in _includes(document)]
    # The newest version wins where files meet: to lower a file would carry away what its author
    # wrote, and to raise one only rewrites it.
    version = newest(document.version, *(each.document.version for each in found if each), *_needs(document))
    document = upgrade_document(document, version, sink, carriers=carriers)
    # By identity, since two equal includes in different folders may name different files. Upgrading
    # makes new nodes, so the pairs are made after it.
    by_identity = {id(include): each for include, each in zip(_includes(document), found, strict=True)}
    document = _Expansion(by_identity, version, sink, carriers).document(document)
    namespaces = joined(document.namespaces, (each.document.namespaces for each in found if each))
    return document.copy(namespaces=namespaces)


def _needs(document: Document) -> Iterator[str]:
    """The versions that have what includes in models become: models in models, and frames for merged ones."""
    inner = [include for model in outer_models(document) for include in nested_includes(model)]
    if inner:
        yield _NESTED_MODELS
    if any(include.merge for include in inner):
        yield _NAMED_FRAMES


def _includes(document: Document) -> Iterator[Include]:
    yield from document.includes
    for world in document.worlds:
        yield from world.includes
    for model in outer_models(document):
        yield from nested_includes(model)


@dataclass(slots=True)
class _Expansion:
    """One expansion; `found` has the document of each include by the include's identity, which copies keep."""

    found: dict[int, Included | None]
    version: str | None
    sink: DiagnosticSink
    carriers: bool
    ready: dict[int, Document] = field(default_factory=dict[int, Document])

    def document(self, document: Document) -> Document:
        models = tuple(map(self.model, document.models))
        worlds = tuple(map(self.world, document.worlds))
        document = document.copy(models=models, worlds=worlds, version=self.version)
        for include, source in self._split(document.includes):
            if include.merge:
                self._refuse_merge(include, "the root of a file is no model")
                continue
            document = self._add_included(document, include, source)
        return document.copy(includes=self._unread_includes(document.includes))

    def world(self, world: World) -> World:
        world = world.copy(models=tuple(map(self.model, world.models)))
        for include, source in self._split(world.includes):
            if include.merge:
                model = self._model(include, source)
                world = merge_into_world(world, include, model, self.sink, source.frame) if model else world
                continue
            world = self._add_included(world, include, source)
        return world.copy(includes=self._unread_includes(world.includes))

    def model(self, model: Model) -> Model:
        model = replace_fields(model, models=tuple(map(self.model, model.models)))
        if not model.includes:
            return model
        for include, source in self._split(model.includes):
            included = self._model(include, source)
            if included is not None and include.merge:
                model = merge_into_model(model, include, included, self.sink, source.frame)
            elif included is not None:
                nested = placed_model(include, included, self.sink, source.frame)
                model = model.copy(models=(*model.models, nested))
        return model.copy(includes=self._unread_includes(model.includes))

    def _split(self, includes: Iterable[Include]) -> Iterator[tuple[Include, Included]]:
        for include in includes:
            source = self.found.get(id(include))
            if source is not None:
                account_replaced(include, self.sink)
                yield include, source

    def _unread_includes(self, includes: Iterable[Include]) -> tuple[Include, ...]:
        return tuple(include for include in includes if self.found.get(id(include)) is None)

    def _ready(self, source: Included) -> Document:
        """The document of an include in the version and with the paths of this one."""
        done = self.ready.get(id(source))
        if done is None:
            done = upgrade_document(source.document, self.version, self.sink, carriers=self.carriers)
            # libsdformat leaves a relative path alone and finds the file by the place of the file
            # that it was read from; a text has no such memory.
            done = relocate(done, source.folder)
            self.ready[id(source)] = done
        return done

    def _add_included(self, holder: Holder, include: Include, source: Included) -> Holder:
        """The world or root with what is included: a model, a light or an actor."""
        document = self._ready(source)
        lights = document.lights if not document.models else ()
        if lights:
            light = placed_light(include, lights[0])
            report_leftovers(include, self.sink)
            return holder.copy(lights=(*holder.lights, light))
        actor = None if document.models else placed_actor(include, document)
        if actor is not None:
            report_leftovers(include, self.sink)
            return holder.copy(opaque=(*holder.opaque, actor))
        model = self._model(include, source)
        if model is None:
            return holder
        placed = placed_model(include, model, self.sink, source.frame)
        return holder.copy(models=(*holder.models, placed))

    def _model(self, include: Include, source: Included) -> Model | None:
        models = self._ready(source).models
        if not models:
            message = f"{include.uri!r} has no model that could be included here"
            self.sink.report(rules.INCLUDE_WITHOUT_MODEL, message, include.location, found=include.uri)
            return None
        count = len(source.document.models)  # newer versions have one at most
        if count > 1:
            message = f"{include.uri!r} has {count} models; {models[0].name!r} is taken"
            self.sink.report(rules.INCLUDE_TAKES_FIRST, message, include.location, found=include.uri)
        return models[0]

    def _refuse_merge(self, include: Include, why: str) -> None:
        message = f"{include.uri!r} cannot be merged: {why}"
        self.sink.report(rules.UNMERGEABLE_INCLUDE, message, include.location, found=include.uri)
