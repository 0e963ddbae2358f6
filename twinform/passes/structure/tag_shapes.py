"""Name shapes of URDF so that Gazebo applies the `<gazebo>` tags of their links to them."""

from collections.abc import Callable, Iterator, Mapping
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import GAZEBO_SHAPE_NAME
from twinform.ir import Collision, Document, Element, Format, GazeboExtension, Link, Model, Visual, replace_fields
from twinform.passes.carriers.lumped_names import LUMP, mentions_collisions
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.gazebo_tags import lumped_links
from twinform.passes.shared.nodes import unique_name
from twinform.passes.structure.tagged_shapes import (
    KINDS,
    SeenShape,
    seen_shapes,
    shape_name,
    tagged_links,
    tagging_links,
)

AnyShape = Visual | Collision
Rename = Callable[[AnyShape, str, str], AnyShape]
"""Gives a shape of a kind a new name."""
WrongTags = tuple[SeenShape, set[str], str | None]
"""A shape, the links whose tags it gets, and a name with which it would only get those of its own link."""


class TagShapes(Pass):
    """Name shapes of URDF so that Gazebo applies the `<gazebo>` tags of their link to them, and of no other one.

    libsdformat tells by the name of a shape, once it has lumped fixed joints, which links' tags it gets; one whose name
    does not begin with that of its link gets none.

    Changes: 1. a shape that would miss tags of its link, or get those of another, becomes `LINK_NAME`, and in a link
    that is lumped `LINK_collision_NAME`; 2. contact sensors name collisions as libsdformat calls them.
    Never touches: shapes that are tagged as they should be, and SDF.
    Diagnostics: `gazebo-shape-name` for each new name.
    """

    name: ClassVar[str] = "tag-shapes"
    example: ClassVar[str] = "set-surface{mu=0.5},tag-shapes"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with names that Gazebo keeps."""
        if document.format is not Format.URDF:
            return document

        def rename(shape: AnyShape, name: str, kind: str) -> AnyShape:
            sink.report(GAZEBO_SHAPE_NAME, describe_renaming(shape, name, kind), shape.location, found=shape.name)
            return shape.copy(name=name)

        return replace_fields(
            document, models=tuple(name_shapes_for_gazebo(model, rename) for model in document.models)
        )


def describe_renaming(shape: AnyShape, name: str, kind: str) -> str:
    """A message about a new name."""
    called = f"{kind} {shape.name!r}" if shape.name else f"a {kind} without a name"
    return f"{called} is called {name!r}, so that Gazebo applies the tags of its own link alone to it"


def name_shapes_for_gazebo(model: Model, rename: Rename) -> Model:
    """The model with names of shapes that Gazebo keeps, also in its contact sensors."""
    before = model
    for field, kind in KINDS.items():
        names = {id(seen.shape): name for seen, _, name in wrongly_tagged(model, field) if name is not None}
        if names:
            links = tuple(
                _rename_shapes(link, field, names, lambda one, name, of=kind: rename(one, name, of))
                for link in model.links
            )
            model = model.copy(links=links)
    return _follow_in_contacts(before, model) if mentions_collisions(model) else model


def wrongly_tagged(model: Model, field: str) -> Iterator[WrongTags]:
    """The visuals or collisions that do not get exactly the tags of their own link."""
    tagged, hosts, kind = tagged_links(model, field), lumped_links(model), KINDS[field]
    for seen in seen_shapes(model, field) if tagged else ():
        own, found = {seen.link} & tagged, tagging_links(seen, kind, hosts) & tagged
        if found != own:
            names = (
                name
                for name in _candidates(seen, kind)
                if _tagging_links_under(name, seen, kind, hosts) & tagged == own
            )
            yield seen, found, next(names, None)


def _candidates(seen: SeenShape, kind: str) -> tuple[str, ...]:
    """Names that are kept in a link, in a lumped link, and in one lumped into a link with whose name its own begins."""
    bare = (seen.shape.name or kind).replace(LUMP, "_")
    lumped = f"{seen.link}_{kind}_{bare}"
    return f"{seen.link}_{bare}", lumped, f"{seen.host}{LUMP}{lumped}"


def _tagging_links_under(name: str, seen: SeenShape, kind: str, hosts: Mapping[str, str]) -> set[str]:
    return tagging_links(seen._replace(name=shape_name(seen.host, name, kind, 0)), kind, hosts)


def _rename_shapes(
    link: Link, field: str, names: Mapping[int, str], rename: Callable[[AnyShape, str], AnyShape]
) -> Link:
    shapes: tuple[AnyShape, ...] = getattr(link, field)
    taken = {shape.name for shape in shapes if id(shape) not in names}
    made: list[AnyShape] = []
    for shape in shapes:
        name = names.get(id(shape))
        made.append(shape if name is None else rename(shape, unique_name(name, taken)))
        taken.add(made[-1].name)
    return replace_fields(link, **{field: tuple(made)})


def _follow_in_contacts(before: Model, after: Model) -> Model:
    """The model with the names that libsdformat gives to collisions in contact sensors."""
    theirs: dict[str, str] = {}
    own: dict[str, dict[str, str]] = {}
    for old, new in zip(seen_shapes(before, "collisions"), seen_shapes(after, "collisions"), strict=True):
        theirs[old.name] = new.name
        if old.shape.name:
            own.setdefault(old.link, {})[old.shape.name] = new.name

    def follow(extension: GazeboExtension) -> GazeboExtension:
        names = {**theirs, **own.get(extension.reference or "", {})}
        content = tuple(rename_in_contacts(each, names) for each in extension.content)
        return extension.copy(content=content)

    return after.copy(extensions=tuple(map(follow, after.extensions)))


def rename_in_contacts(element: Element, names: Mapping[str, str], inside: str = "") -> Element:
    """A sensor with other names of collisions in its `<contact>`."""
    path = f"{inside}/{element.name}"
    if path == "/sensor/contact/collision":
        name = names.get((element.text or "").strip())
        return element if name is None else element.copy(text=name)
    if not "/sensor/contact".startswith(path):
        return element
    return element.copy(children=tuple(rename_in_contacts(each, names, path) for each in element.children))
