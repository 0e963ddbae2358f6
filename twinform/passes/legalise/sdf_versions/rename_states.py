"""Since 1.12 the states in a world have names of their own."""

from functools import partial
from typing import ClassVar

from twinform.ir import Document, Element, World
from twinform.passes.legalise.sdf_versions.base import VersionPass, map_own_elements, map_worlds
from twinform.passes.legalise.sdf_versions.carriers import Keeper

_NAMES = {
    "state": {"model": "model_state", "light": "light_state"},
    "model_state": {"model": "model_state", "link": "link_state", "joint": "joint_state"},
    "link_state": {"collision": "collision_state"},
}
"""By the new name of a state: the old names of what it holds, and the new ones."""


class RenameStates(VersionPass):
    """Call the states of models, links, joints and lights as 1.12 does, or with `back` as before.

    Changes: 1. `<model>` in a `<state>` is `<model_state>`, and so on; 2. the second `<angle>` of a joint is the
    position of its `axis2_state`.
    """

    name: ClassVar[str] = "rename-states"
    back: bool = False

    def change(self, document: Document, keeper: Keeper) -> Document:
        """The document with states in the words of the version."""

        def of_state(element: Element) -> Element:
            return _renamed(element, "state", back=self.back) if element.name == "state" else element

        def in_world(world: World) -> World:
            return map_own_elements(world, of_state)

        return map_worlds(document, in_world)


def _renamed(element: Element, kind: str, *, back: bool) -> Element:
    """A state with its children renamed; `kind` is its new name."""
    if kind == "joint_state":
        return _second_angle_back(element) if back else _second_angle(element)
    names = _NAMES.get(kind, {})
    old_names = {new: old for old, new in names.items()}
    children = tuple(map(partial(_child, names, old_names, back=back), element.children))
    return element.model_copy(update={"children": children})


def _child(names: dict[str, str], old_names: dict[str, str], child: Element, *, back: bool) -> Element:
    kind = child.name if back else names.get(child.name, "")
    if kind not in old_names:
        return child
    changed = _renamed(child, kind, back=back)
    return changed.model_copy(update={"name": old_names[kind] if back else kind})


def _second_angle(joint: Element) -> Element:
    def moved(child: Element) -> Element:
        if child.name != "angle" or child.get("axis") != "1":
            return child
        return Element(name="axis2_state", children=(Element(name="position", text=child.text),))

    return joint.model_copy(update={"children": tuple(map(moved, joint.children))})


def _second_angle_back(joint: Element) -> Element:
    def moved(child: Element) -> Element:
        position = child.children[0] if child.name == "axis2_state" and len(child.children) == 1 else None
        if position is None or position.name != "position" or position.attributes:
            return child
        return Element(name="angle", attributes=(("axis", "1"),), text=position.text)

    return joint.model_copy(update={"children": tuple(map(moved, joint.children))})
