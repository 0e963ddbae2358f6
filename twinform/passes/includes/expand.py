"""Replaces the includes of a document by the models of other files, with their paths and versions adapted."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import field
from posixpath import normpath
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Include, Model, World, replace_fields
from twinform.ir.element import joined
from twinform.ir.scopes import nested_includes, outer_models, outside_worlds
from twinform.ir.transform import Transform
from twinform.lazy import lazy_pattern
from twinform.passes.includes.merge import (
    account_replaced_include,
    merge_into_model,
    merge_into_world,
    place_actor,
    place_light,
    place_model,
    report_leftovers,
)
from twinform.passes.shared.document_uris import map_uris
from twinform.schemas import print_version, version_read

Holder = TypeVar("Holder", Document, World)
_NESTED_MODELS = "1.5"
_NAMED_FRAMES = "1.7"
"""The first versions of SDF with nested models and with named frames."""
_NOT_RELATIVE = lazy_pattern(r"[A-Za-z][\w+.-]*:|/|__")
"""The beginning of a URI, of a path from the root, or of a name such as `__default__`."""
_HERE = frozenset({"", "."})


@dataclass(frozen=True, slots=True)
class Included:
    """The document that an include names, with its own includes expanded, and the URI of its folder.

    `frame` is the frame of its model relative to the frame that the include places: that of the root link for URDF,
    whatever frame the model had in the SDF that it was converted from.
    """

    document: Document
    folder: str
    frame: Transform = field(default_factory=Transform)


Resolver = Callable[[Include], Included | None]
"""Returns the document of an include; None leaves the include where it is."""


def has_includes(document: Document) -> bool:
    """Whether there is any include in a document."""
    return any(_includes(document))


def expand_includes(document: Document, resolve: Resolver, sink: DiagnosticSink, *, carriers: bool = True) -> Document:
    """The document with included models in place of its includes.

    All files are upgraded to the newest version among them. What that version lacks is carried, or dropped without
    `carriers`.
    """
    found = [resolve(include) for include in _includes(document)]
    # The newest version wins where files meet: to lower a file would carry away what its author
    # wrote, and to raise one only rewrites it.
    version = newest_version(
        document.version, *(each.document.version for each in found if each), *_needed_versions(document)
    )
    document = upgrade_document(document, version, sink, carriers=carriers)
    # By identity, since two equal includes in different folders may name different files. Upgrading
    # makes new nodes, so the pairs are made after it.
    by_identity = {id(include): each for include, each in zip(_includes(document), found, strict=True)}
    document = _Expansion(by_identity, version, sink, carriers).document(document)
    namespaces = joined(document.namespaces, (each.document.namespaces for each in found if each))
    return document.copy(namespaces=namespaces)


def _needed_versions(document: Document) -> Iterator[str]:
    """The versions that included models need: for nested models, and for frames of merged ones."""
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
    """One expansion; `found` has the document of each include by the identity of the include, which copies keep."""

    found: dict[int, Included | None]
    version: str | None
    sink: DiagnosticSink
    carriers: bool
    ready: dict[int, Document] = field(default_factory=dict[int, Document])

    def document(self, document: Document) -> Document:
        models = tuple(map(self.model, document.models))
        worlds = tuple(map(self.world, document.worlds))
        document = document.copy(models=models, worlds=worlds, version=self.version)
        for include, source in self._found_includes(document.includes):
            if include.merge:
                self._refuse_merge(include, "the root of a file is no model")
                continue
            document = self._add_included(document, include, source)
        return document.copy(includes=self._unread_includes(document.includes))

    def world(self, world: World) -> World:
        world = world.copy(models=tuple(map(self.model, world.models)))
        for include, source in self._found_includes(world.includes):
            if include.merge:
                model = self._included_model(include, source)
                world = merge_into_world(world, include, model, self.sink, source.frame) if model else world
                continue
            world = self._add_included(world, include, source)
        return world.copy(includes=self._unread_includes(world.includes))

    def model(self, model: Model) -> Model:
        model = replace_fields(model, models=tuple(map(self.model, model.models)))
        if not model.includes:
            return model
        for include, source in self._found_includes(model.includes):
            included = self._included_model(include, source)
            if included is not None and include.merge:
                model = merge_into_model(model, include, included, self.sink, source.frame)
            elif included is not None:
                nested = place_model(include, included, self.sink, source.frame)
                model = model.copy(models=(*model.models, nested))
        return model.copy(includes=self._unread_includes(model.includes))

    def _found_includes(self, includes: Iterable[Include]) -> Iterator[tuple[Include, Included]]:
        for include in includes:
            source = self.found.get(id(include))
            if source is not None:
                account_replaced_include(include, self.sink)
                self._report_several(include, source.document)
                yield include, source

    def _unread_includes(self, includes: Iterable[Include]) -> tuple[Include, ...]:
        return tuple(include for include in includes if self.found.get(id(include)) is None)

    def _prepare(self, source: Included) -> Document:
        """The document of an include with the version and the paths of the including document."""
        done = self.ready.get(id(source))
        if done is None:
            done = upgrade_document(source.document, self.version, self.sink, carriers=self.carriers)
            # libsdformat leaves a relative path alone and finds the file by the place of the file
            # that it was read from; a text has no such memory.
            done = relocate(done, source.folder)
            self.ready[id(source)] = done
        return done

    def _add_included(self, holder: Holder, include: Include, source: Included) -> Holder:
        """The world or document with an included model, light or actor."""
        document = self._prepare(source)
        lights = document.lights if not document.models else ()
        if lights:
            light = place_light(include, lights[0])
            report_leftovers(include, self.sink)
            return holder.copy(lights=(*holder.lights, light))
        actor = None if document.models else place_actor(include, document)
        if actor is not None:
            report_leftovers(include, self.sink)
            return holder.copy(opaque=(*holder.opaque, actor))
        model = self._included_model(include, source)
        if model is None:
            return holder
        placed = place_model(include, model, self.sink, source.frame)
        return holder.copy(models=(*holder.models, placed))

    def _included_model(self, include: Include, source: Included) -> Model | None:
        models = self._prepare(source).models
        if not models:
            message = f"{include.uri!r} has no model that could be included here"
            self.sink.report(rules.INCLUDE_WITHOUT_MODEL, message, include.location, found=include.uri)
            return None
        return models[0]

    def _report_several(self, include: Include, document: Document) -> None:
        count = len(outside_worlds(document))
        if count > 1:
            message = f"{include.uri!r} has {count} models, lights and actors; an include stands for one"
            self.sink.report(rules.INCLUDE_TAKES_FIRST, message, include.location, found=include.uri, refused=True)

    def _refuse_merge(self, include: Include, why: str) -> None:
        message = f"{include.uri!r} cannot be merged: {why}"
        self.sink.report(rules.UNMERGEABLE_INCLUDE, message, include.location, found=include.uri)


def relocate(document: Document, folder: str) -> Document:
    """The document with relative paths that lead to the same files from outside of its `folder`."""
    if folder in _HERE:
        return document
    return map_uris(document, lambda path, _kind, _where: relocate_path(path, folder) or path)


def relocate_path(path: str | None, folder: str) -> str | None:
    """A relative path from outside of the folder; any other text as it is."""
    if not path or not path.strip() or _NOT_RELATIVE.match(path.strip()) or folder in _HERE:
        return path
    # `model://arm` and `meshes/a.dae` are `model://arm/meshes/a.dae`; without taking the scheme
    # apart, normpath would make one slash of two.
    scheme, separator, rest = folder.rpartition("://")
    return f"{scheme}{separator}{normpath(f'{rest}/{path.strip()}')}"


def newest_version(*versions: str | None) -> str | None:
    """The newest of the versions that files are read by; the first one as it is declared where no other is newer."""
    newest = max(version_read("sdf", version) for version in versions)
    return versions[0] if version_read("sdf", versions[0]) == newest else print_version(newest)


def upgrade_document(document: Document, version: str | None, sink: DiagnosticSink, *, carriers: bool) -> Document:
    """The document in the syntax of a version that is not older than its own."""
    before, after = version_read("sdf", document.version), version_read("sdf", version)
    if before >= after:
        return document
    from twinform.passes.sdf_versions import raise_for_merging  # noqa: PLC0415 - few files need all the steps

    own = DiagnosticSink(document.location.file or sink.file, sink.strict, origins=sink.origins)
    for step in raise_for_merging(print_version(before), print_version(after), carriers=carriers):
        document = step.run(document, own)
    # A file that is included a hundred times is reported once.
    sink.extend_new(own.diagnostics)
    sink.entries.extend(own.entries)
    return document
