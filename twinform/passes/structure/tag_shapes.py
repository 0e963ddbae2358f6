"""Name shapes of URDF so that Gazebo applies the `<gazebo>` tags of their links to them.

libsdformat lumps fixed joints, gives every shape a new name, and then decides by the name alone whose tags a shape
gets: those of its link while there is no `_fixed_joint_lump__` in the name, otherwise those of a lumped link whose name
follows (parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision; the same for visuals).
"""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import ClassVar, NamedTuple

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import GAZEBO_SHAPE_NAME
from twinform.ir import Collision, Document, Element, Format, GazeboExtension, Link, Model, Visual, replace_fields
from twinform.passes.carriers.lumped_names import LUMP, mentions_collisions
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.gazebo_tags import LINK_TAGS, TRUE, Tag, lumped_joints, lumped_links, value_text
from twinform.passes.shared.nodes import unique_name
from twinform.passes.structure.gazebo_blocks import shape_elements

KINDS: Mapping[str, str] = {"visuals": "visual", "collisions": "collision"}
"""The fields of a link with shapes, and the word that libsdformat adds to their names."""
_PARTS = frozenset({"contact", "friction"})
_OF_CONTACT = frozenset({"kp", "kd", "max_vel", "min_depth"})


class SeenShape(NamedTuple):
    """A shape as libsdformat reads it: its own link, the link that it is lumped into, and its name there."""

    shape: Visual | Collision
    link: str
    host: str
    name: str


def shape_name(link: str, name: str | None, kind: str, number: int) -> str:
    """The name that libsdformat gives the shape with this number in a link; a name given before grows once more."""
    made = f"{name or link}_{kind}" + (f"_{number}" if number else "")
    return made if made.startswith(link) else f"{link}{LUMP}{made}"


def seen_shapes(model: Model, field: str) -> Iterator[SeenShape]:
    """Every visual or collision, numbered in each link as libsdformat does when it lumps links."""
    links = {link.name: link for link in model.links}
    hosts, below = lumped_links(model), dict[str, list[str]]()
    for child, joint in lumped_joints(model).items():
        below.setdefault(joint.parent or "", []).append(child)
    for host in dict.fromkeys(hosts.values()):
        number, names, taken = 0, [host], {host}
        while names:
            name = names.pop()
            names += (each for each in reversed(below.get(name, [])) if each not in taken)  # joints may make a loop
            taken.update(names)
            for shape in getattr(links[name], field):
                called = shape.name or (None if name == host else name)
                yield SeenShape(shape, name, host, shape_name(host, called, KINDS[field], number))
                number += 1


def tagging_links(seen: SeenShape, kind: str, hosts: Mapping[str, str]) -> set[str]:
    """The links whose tags a shape gets: the link that it is in, or the lumped links that its name contains."""
    if LUMP not in seen.name:
        return {seen.host}
    return {name for name in _lumped_names_in(seen.name, kind) if hosts.get(name) == seen.host != name}


def _lumped_names_in(name: str, kind: str) -> Iterator[str]:
    """All texts between a mark of lumping and a later word for the kind of shape."""
    for mark in re.finditer(LUMP, name):
        for word in re.finditer(f"_{kind}", name[mark.end() :]):
            yield name[mark.end() : mark.end() + word.start()]


def tagged_links(model: Model, field: str) -> set[str]:
    """The links with tags for their visuals or collisions."""
    return {
        extension.reference
        for extension in model.extensions
        if extension.reference and shape_elements(extension.content, field)
    }


def unread_tags(extensions: Iterable[GazeboExtension], field: str) -> Iterator[Element]:
    """The elements in the extensions of a link that libsdformat reads and then loses, for visuals or collisions.

    The author meant them, so a conversion to SDF keeps them, and reports that Gazebo loses them in URDF.
    """
    if field == "visuals":
        materials = (each for extension in extensions for each in extension.content if each.name == "material")
        yield from (each for each in materials if each.children)  # it asks for a name: GetKeyValueAsString
    else:
        yield from _unread_collision_tags(extensions)


def _unread_collision_tags(extensions: Iterable[GazeboExtension]) -> Iterator[Element]:
    """The tags for collisions that set something which Gazebo never sees.

    libsdformat remembers the `<ode>` of `<contact>` and `<friction>`, and makes them in every collision that has none
    of them after a `<gazebo>`. Where a `<surface>` without one of the two replaces another surface, it still remembers
    that of the old one, which it has deleted, and later tags go there. And a tag for the collision itself replaces the
    first element of its kind and stands behind the others, of which the first counts (parser_urdf.cc,
    InsertSDFExtensionCollision and AddKeyValue).
    """
    at_hand, lost, standing = set[str](), set[str](), Counter[str]()
    for extension in extensions:
        for element in (each for blob in extension.content if blob.name == "collision" for each in blob.children):
            standing[element.name] += 1
            if element.name == "surface":
                parts = {part.name: part.find("ode") is not None for part in reversed(element.children)}
                lost = (lost | at_hand) - parts.keys()
                at_hand = (at_hand - parts.keys()) | {name for name in _PARTS if parts.get(name)}
        at_hand = set(_PARTS)
        for element in extension.content:
            tag = LINK_TAGS.get(element.name)
            if tag and (_part_of(tag) in lost or (tag.target == "collision" and standing[tag.field] > 1)):
                yield element
            elif tag and tag.target == "collision":
                standing[tag.field] = 1


def _part_of(tag: Tag) -> str:
    """The part of a surface that a tag sets."""
    if tag.target != "surface":
        return ""
    return "contact" if tag.field in _OF_CONTACT else "friction"


def find_early_static(model: Model, sink: DiagnosticSink) -> None:
    """Report a true `<static>` of a robot that its last `<gazebo>` does not repeat."""
    own = [extension for extension in model.extensions if not extension.reference]
    statics = [(each, element) for each in own for element in each.content if element.name == "static"]
    if not statics or statics[-1][0] is own[-1] or value_text(statics[-1][1]).lower() not in TRUE:
        return
    extension, element = statics[-1]
    message = (
        "<static> is true, and a later <gazebo> for the robot does not say so, which libsdformat before 12.7 and 13.3 "
        "takes for false"
    )
    where, related = element.location if element.source else extension.location, (own[-1].location,)
    help = "write it into the last <gazebo> without a reference"
    sink.report(rules.EARLY_STATIC, message, where, found=element.name, related=related, help=help)


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
