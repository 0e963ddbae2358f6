"""Finds what libsdformat, Gazebo's reader of URDF, would refuse, leave out or rename in a robot that came from SDF.

libsdformat lumps links that are fixed to each other, and leaves out links that then have no mass, with all that hangs
from them. It refuses a floating joint unless a frame in `<gazebo>` has its name. The rules are those of its
`parser_urdf.cc`, tried on libsdformat 12 and 17.
"""

from collections import defaultdict
from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from twinform.diagnostics import Location
from twinform.ir import Capsule, Element, Model
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE
from twinform.passes.shared.gazebo_tags import lumped_links

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


def changes(original: Model, made: Model, named: AbstractSet[str] = frozenset()) -> Iterator[GazeboChange]:
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
