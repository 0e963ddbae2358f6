"""Names of lumped collisions, and the annotations that restore them.

libsdformat calls the collision of a link that it lumps into another one `HOST_fixed_joint_lump__NAME_collision_N`, and
URDF for Gazebo names it so in contact sensors and plugins. Here nothing is lumped unless somebody asks for it, and the
collision keeps its own name. The annotation stands beside the text that was changed:

    <collision>pad_collision</collision><tf:lumped instead_of="pad_collision">base_fixed_joint_lump__pad_...</tf:lumped>
"""

from collections.abc import Mapping
from typing import NamedTuple

from twinform.ir import Element, Model
from twinform.passes.carriers.carriers import NAMESPACE

LUMP = "_fixed_joint_lump__"
_LUMPED = f"{{{NAMESPACE}}}lumped"


class Followed(NamedTuple):
    """The name of a collision, and the link that it is on."""

    name: str
    link: str


def mentions_collisions(model: Model) -> bool:
    """Whether a `<gazebo>` element may name a collision: in a contact sensor, or a lumped one anywhere."""
    elements = (one for each in model.extensions for part in each.content for one in part.walk())
    return any(one.name == "contact" or LUMP in (one.text or "") for one in elements)


def followed(element: Element, names: Mapping[str, Followed], *, carriers: bool) -> Element:
    """The element with each text that is a key of `names` replaced, and annotated with `carriers`."""
    children: list[Element] = []
    for child in element.children:
        found = names.get((child.text or "").strip())
        inner = followed(child, names, carriers=carriers)
        children.append(inner.copy(text=found.name) if found else inner)
        if found and carriers:
            text = (child.text or "").strip()
            children.append(Element.unchecked(name=_LUMPED, attributes=(("instead_of", found.name),), text=text))
    same = len(children) == len(element.children) and all(map(_is_same, children, element.children))
    return element if same else element.copy(children=tuple(children))


def has_annotations(model: Model) -> bool:
    """Whether an annotation has the name of a lumped collision."""
    return any(one.name == _LUMPED for each in model.extensions for part in each.content for one in part.walk())


def restored(element: Element, names: Mapping[str, Followed], stale: list[Element]) -> Element:
    """The element with annotated old names restored, where `names` maps them to what stands there now.

    A text that was edited since stays, as does one whose old name now means another collision or none; the annotations
    of these are added to `stale`.
    """
    if not any(one.name == _LUMPED for one in element.walk()):
        return element
    children: list[Element] = []
    for child in element.children:
        if child.name != _LUMPED:
            children.append(restored(child, names, stale))
            continue
        meant = names.get(child.text or "")
        text = (children[-1].text or "").strip() if children else None
        if meant and text == child.get("instead_of") == meant.name:
            children[-1] = children[-1].copy(text=child.text)
        else:
            stale.append(child)
    return element.copy(children=tuple(children))


def _is_same(one: Element, other: Element) -> bool:
    return one is other
