"""Frames of poses and of joint axes, which have names since SDF 1.7: `relative_to` and `expressed_in`."""

from functools import partial
from typing import ClassVar, TypeVar

from twinform.ir import (
    OPAQUE,
    Axis,
    Document,
    Element,
    Joint,
    Model,
    Node,
    Opaque,
    Pose,
    World,
    map_children,
    replace_fields,
    rewrite,
)
from twinform.ir.frames import MODEL, WORLD
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign, map_own_elements

AnyNode = TypeVar("AnyNode", bound=Node)

_OLD = "frame"
_NEW = "relative_to"


class NamePoseFrames(VersionPass):
    """Call the frame of a pose `relative_to`, which SDF 1.5 and 1.6 call `frame`.

    Changes: every pose, those in untyped elements too.
    Never touches: an empty name, which means nothing; the pose of a model at the root of the file, which names no frame
    in newer versions; in an untyped element the pose in a frame of its own, which goes along with that frame.
    """

    name: ClassVar[str] = "name-pose-frames"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with poses in the syntax of 1.7."""
        models = tuple(map(_rename_in_root, document.models))
        rest = map_children(document.copy(models=()), _rename_in)
        return rest.copy(models=models)


def _rename_in_root(model: Model) -> Model:
    """A model at the root of the file, whose own pose stays."""
    return _rename_in(model).copy(pose=model.pose)


def _rename_in(node: AnyNode) -> AnyNode:
    return rewrite(node, Node, _rename_node, having=OPAQUE)


def _rename_node(node: Node) -> Node:
    return _rename_frame(node) if isinstance(node, Pose) else map_own_elements(node, _rename_in_element)


def _rename_frame(pose: Pose) -> Pose:
    found = next((part for part in pose.opaque if part.attribute and part.attribute[0] == _OLD), None)
    # The specification of 1.5 and 1.6 gives `frame` an empty default, and exporters write
    # `frame=""` into every pose.
    if found is None or not found.attribute or not found.attribute[1] or pose.relative_to is not None:
        return pose
    rest: tuple[Opaque, ...] = tuple(part for part in pose.opaque if part is not found)
    return pose.copy(**{_NEW: found.attribute[1], "opaque": rest})


def _rename_in_element(element: Element, own: frozenset[str | None] = frozenset()) -> Element:
    """An untyped element with its poses renamed; `own` are the frames of the one around it."""
    if element.name == "pose":
        return element if element.get(_OLD) in own else _rename_attribute(element)
    if not element.children or element.name == "plugin" or is_foreign(element):
        return element
    frames = frozenset(child.get("name") for child in element.find_all("frame"))
    return replace_fields(element, children=tuple(_rename_in_element(child, frames) for child in element.children))


def _rename_attribute(pose: Element) -> Element:
    if not pose.get(_OLD) or pose.get(_NEW) is not None:
        return pose
    attributes = tuple((_NEW if name == _OLD else name, value) for name, value in pose.attributes)
    return pose.copy(attributes=attributes)


_BY_NAME = (1, 7)
"""Since this version an axis names its frame."""


class NameAxisFrames(VersionPass):
    """Say that an axis is in the model frame: by `use_parent_model_frame` from 1.5 on, by `expressed_in` from 1.7 on.

    Changes: 1. every axis of a file before 1.5 (`source`), where all are in the model frame; 2. from 1.7 on, those with
    `use_parent_model_frame` true. A joint of a world has no model around it: its axis is in the world.
    Never touches: `use_parent_model_frame` false, which 1.7 does not have; nor, with `both`, where it is true: a
    file with syntax of many versions has each of them back.
    """

    name: ClassVar[str] = "name-axis-frames"
    source_before_1_5: bool = False
    both: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with axes in the syntax of the version."""
        change = partial(
            _name_axis_frames, always=self.source_before_1_5, named=self.number >= _BY_NAME, both=self.both
        )

        def in_world(world: World) -> World:
            if not world.joints:
                return world
            return world.copy(joints=tuple(change(joint, frame=WORLD) for joint in world.joints))

        return rewrite(rewrite(document, World, in_world), Joint, partial(change, frame=MODEL))


def _name_axis_frames(joint: Joint, *, always: bool, named: bool, both: bool, frame: str) -> Joint:
    update: dict[str, object] = {}
    for field in ("axis", "axis2"):
        axis: Axis | None = getattr(joint, field)
        if axis is not None and axis.expressed_in is None and _is_in_model(axis, always=always):
            word = True if not named else axis.use_parent_model_frame if both else None
            name = frame if named else None
            update[field] = axis.copy(expressed_in=name, use_parent_model_frame=word)
    return joint.copy(**update) if update else joint


def _is_in_model(axis: Axis, *, always: bool) -> bool:
    # Before 1.5 every axis was in the model frame; with 1.5 the default became the joint's, and the
    # attribute came to say otherwise.
    if axis.use_parent_model_frame is None:
        return always
    return axis.use_parent_model_frame
