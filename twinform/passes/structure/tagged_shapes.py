"""Which `<gazebo>` tags of links libsdformat applies to which shapes of URDF, and how it names the shapes.

It lumps fixed joints, gives every shape a new name, and then decides by the name alone whose tags a shape gets: those
of its link while there is no `_fixed_joint_lump__` in the name, otherwise those of a lumped link whose name follows
(parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision; the same for visuals).
"""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Collision, Element, GazeboExtension, Model, Visual
from twinform.passes.carriers.lumped_names import LUMP
from twinform.passes.shared.gazebo_tags import LINK_TAGS, TRUE, Tag, lumped_joints, lumped_links, value_text
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
        number, names = 0, [host]
        while names:
            name = names.pop()
            names += reversed(below.get(name, []))
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
