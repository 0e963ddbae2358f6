"""Which `<gazebo>` tags of links libsdformat applies to which shapes of URDF, and what it calls these.

It lumps fixed joints, names every shape anew, and then tells by the name alone whose tags a shape gets: those of its
link while there is no `_fixed_joint_lump__` in the name, and otherwise those of a lumped link whose name follows it
(parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision; the same for visuals).
"""

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from twinform.ir import Collision, Model, Visual
from twinform.passes.carriers.lumped_names import LUMP
from twinform.passes.structure.gazebo_blocks import of_shapes
from twinform.passes.transforms.lumped_links import lumped_joints, lumped_links

KINDS: Mapping[str, str] = {"visuals": "visual", "collisions": "collision"}
"""The fields of a link that have shapes, and what libsdformat adds to their names."""


class SeenShape(NamedTuple):
    """A shape as libsdformat has it: its own link, the link that it is in once links are lumped, and its name there."""

    shape: Visual | Collision
    link: str
    host: str
    name: str


def shape_name(link: str, name: str | None, kind: str, number: int) -> str:
    """What libsdformat calls the shape of this number in a link; a name that it gave before grows once more."""
    made = f"{name or link}_{kind}" + (f"_{number}" if number else "")
    return made if made.startswith(link) else f"{link}{LUMP}{made}"


def seen_shapes(model: Model, field: str) -> Iterator[SeenShape]:
    """Every shape of the visuals or collisions, numbered link by link as libsdformat does when links are lumped."""
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


def tagging(seen: SeenShape, kind: str, hosts: Mapping[str, str]) -> set[str]:
    """The links whose tags a shape gets: that which it is in, or those lumped into it that its name has."""
    if LUMP not in seen.name:
        return {seen.host}
    return {name for name in _named_in(seen.name, kind) if hosts.get(name) == seen.host != name}


def _named_in(name: str, kind: str) -> Iterator[str]:
    """All that stands between a mark of lumping and a later word for the kind of shape."""
    for mark in re.finditer(LUMP, name):
        for word in re.finditer(f"_{kind}", name[mark.end() :]):
            yield name[mark.end() : mark.end() + word.start()]


def tagged_links(model: Model, field: str) -> set[str]:
    """The links with tags about their visuals or collisions."""
    return {
        extension.reference
        for extension in model.extensions
        if extension.reference and of_shapes(extension.content, field)
    }
