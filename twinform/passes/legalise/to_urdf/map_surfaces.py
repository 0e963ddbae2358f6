"""Converting contact surfaces to the `<gazebo>` tags of a link, which apply to all its collisions."""

from typing import ClassVar

from twinform.diagnostics.rules import UNSHARED_SURFACE
from twinform.ir import Collision, Element, GazeboExtension, Link, Model, Surface
from twinform.ir.record import field_values
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.schemas import format_value

_TAGS = {
    "mu": "mu1",
    "mu2": "mu2",
    "fdir1": "fdir1",
    "kp": "kp",
    "kd": "kd",
    "max_vel": "maxVel",
    "min_depth": "minDepth",
}
OF_ALL_COLLISIONS = ("surface", "max_contacts", "laser_retro")
"""Fields of collisions that the tags of a link set for all of its collisions."""


class MapSurfaces(ToUrdfPass):
    """Say surfaces by `<gazebo>` tags where all collisions of a link have the same.

    Changes: 1. a surface of which there are tags for every part becomes these tags, any other a `<collision>` with the
    `<surface>` in it; 2. `max_contacts` and `laser_retro` become tags.
    Never touches: what differs between the collisions of a link; the last pass carries it.
    Diagnostics: `unshared-surface` for a link with such collisions.
    """

    name: ClassVar[str] = "map-surfaces"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with shared surfaces in extensions."""
        links: list[Link] = []
        extensions = list(model.extensions)
        for link in model.links:
            content, fields = _share_fields(link.collisions)
            links.append(_without_fields(link, fields))
            _note_unshared(links[-1], keeper)
            if content:
                extensions.append(
                    GazeboExtension.unchecked(reference=link.name, content=tuple(content), source=link.source)
                )
        return model.copy(links=tuple(links), extensions=tuple(extensions))


def _share_fields(collisions: tuple[Collision, ...]) -> tuple[list[Element], list[str]]:
    """The tags for fields that all collisions have alike, and the names of the fields."""
    if not collisions:
        return [], []
    first, content, fields = collisions[0], list[Element](), list[str]()
    for field in OF_ALL_COLLISIONS:
        value = getattr(first, field)
        # A <gazebo> element is about all collisions of a link, and names of the reader's own for
        # shapes that must have no tag would stop working when libsdformat fixes its naming.
        if value is None or any(getattr(other, field) != value for other in collisions[1:]):
            continue
        fields.append(field)
        if isinstance(value, Surface):
            content.extend(_surface_tags(value))
        else:
            tag = "maxContacts" if field == "max_contacts" else "laserRetro"
            content.append(Element.unchecked(name=tag, text=format_value(value)))
    return content, fields


def _note_unshared(link: Link, keeper: UrdfKeeper) -> None:
    """Warn about fields that differ between the collisions of a link, which Gazebo does not read."""
    left = [(field, one) for field in OF_ALL_COLLISIONS for one in link.collisions if getattr(one, field) is not None]
    if left:
        names = ", ".join(repr(name) for name in dict.fromkeys(one.name for _, one in left))
        what = " and ".join(dict.fromkeys(field for field, _ in left))
        message = f"{what} of {names} of link {link.name!r} is not that of all its collisions: Gazebo gets none of it"
        # A massless link for such a collision, fixed to its own, would work in every version. It is
        # not made here: it would be a link of the robot to all other readers.
        hint = "give Gazebo the SDF, or move such collisions to links of their own that are fixed to this one"
        keeper.sink.report(UNSHARED_SURFACE, message, left[0][1].location, found=left[0][1].name, help=hint)


def _surface_tags(surface: Surface) -> list[Element]:
    written = {name: value for name, value in field_values(surface).items() if value is not None and name != "opaque"}
    if surface.opaque or not written.keys() <= _TAGS.keys():
        return [Element.unchecked(name="collision", children=(to_element(surface, "surface", "sdf"),))]
    return [Element.unchecked(name=_TAGS[name], text=format_value(value)) for name, value in written.items()]


def _without_fields(link: Link, fields: list[str]) -> Link:
    if not fields:
        return link
    cleared = dict.fromkeys(fields)
    return link.copy(collisions=tuple(one.copy(**cleared) for one in link.collisions))
