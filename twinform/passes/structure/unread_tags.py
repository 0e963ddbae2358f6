"""`<gazebo>` content about shapes that libsdformat reads and then loses.

The author meant it, so a conversion to SDF has it, and says that Gazebo has none where it reads the URDF.
"""

from collections import Counter
from collections.abc import Iterable, Iterator

from twinform.ir import Element, GazeboExtension
from twinform.passes.transforms.gazebo_tags import LINK_TAGS, Tag

_PARTS = frozenset({"contact", "friction"})
_OF_CONTACT = frozenset({"kp", "kd", "max_vel", "min_depth"})


def unread_tags(extensions: Iterable[GazeboExtension], field: str) -> Iterator[Element]:
    """The elements in the extensions of a link of which its visuals or collisions have nothing in Gazebo."""
    if field == "visuals":
        materials = (each for extension in extensions for each in extension.content if each.name == "material")
        yield from (each for each in materials if each.children)  # it asks for a name: GetKeyValueAsString
    else:
        yield from _of_collisions(extensions)


def _of_collisions(extensions: Iterable[GazeboExtension]) -> Iterator[Element]:
    """The tags that set something which Gazebo never sees.

    1. libsdformat keeps the `<ode>` of `<contact>` and `<friction>` at hand, and makes them in every collision that has
    none of them after a `<gazebo>`. Where a `<surface>` without one of the two takes the place of another surface, what
    it has at hand of that part is of the old one, which it has deleted, and later tags go there. 2. A tag about the
    collision itself takes the place of the first element of its kind and stands behind the others, of which the first
    counts (parser_urdf.cc, InsertSDFExtensionCollision and AddKeyValue).
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
    """The part of a surface that a tag sets something of."""
    if tag.target != "surface":
        return ""
    return "contact" if tag.field in _OF_CONTACT else "friction"
