"""Elements of world states, renamed in SDF 1.12."""

from typing import ClassVar

from twinform.dataclass import dataclass
from twinform.ir import Document, Element, World
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign, map_elements_named
from twinform.schemas import Fact, Version, table

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
    Never touches: a state whose other name the version does not have where it stands, or of which the other name could
    not say all: the velocity of a joint, the pose of a collision. A later pass carries it as it is.
    """

    name: ClassVar[str] = "rename-states"
    back: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with states in the syntax of the version."""
        renaming = _Renaming(self.number, self.back)
        return map_elements_named("state", document, World, lambda element: renaming.inside(element, "state"))


@dataclass(frozen=True, slots=True)
class _Renaming:
    """Renames states to what they are called since 1.12, or with `back` to what they were called before."""

    version: Version
    back: bool

    def inside(self, element: Element, kind: str) -> Element:
        """A state with its children renamed; `kind` is its name since 1.12."""
        if kind == "joint_state":
            return _move_second_angle_back(element) if self.back else _move_second_angle(element)
        children = tuple(self._child(child, kind) for child in element.children)
        return element.copy(children=children)

    def _child(self, child: Element, around: str) -> Element:
        pairs = [(new, old) if self.back else (old, new) for old, new in _NAMES.get(around, {}).items()]
        name = dict(pairs).get(child.name)
        if name is None or (row := self._row(around, name)) is None:
            return child
        changed = self.inside(child, child.name if self.back else name)
        known = {inner.name for inner in table("sdf").resolve(row).rows}
        # 1.12 made `joint_state` hold velocities and `collision_state` poses, which had no place
        # before. Renamed, they would be lost; with the old name, `leave-out` carries the whole
        # state.
        lost = [inner for inner in changed.children if not is_foreign(inner) and inner.name not in known]
        return child if lost else changed.copy(name=name)

    def _row(self, around: str, name: str) -> Fact | None:
        """The row of a state in the version; None where it has none."""
        rows = table("sdf").definitions[around].rows
        return next((row for row in rows if row.name == name and row.exists_in(self.version)), None)


def _move_second_angle(joint: Element) -> Element:
    def moved(child: Element) -> Element:
        if child.name != "angle" or child.get("axis") != "1":
            return child
        return Element.unchecked(name="axis2_state", children=(Element.unchecked(name="position", text=child.text),))

    return joint.copy(children=tuple(map(moved, joint.children)))


def _move_second_angle_back(joint: Element) -> Element:
    def moved(child: Element) -> Element:
        position = child.children[0] if child.name == "axis2_state" and len(child.children) == 1 else None
        if position is None or position.name != "position" or position.attributes:
            return child
        return Element.unchecked(name="angle", attributes=(("axis", "1"),), text=position.text)

    return joint.copy(children=tuple(map(moved, joint.children)))
