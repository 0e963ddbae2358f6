"""Frames of joint axes: `use_parent_model_frame` and `expressed_in`."""

from functools import partial
from typing import ClassVar

from twinform.ir import Axis, Document, Joint, World, rewrite
from twinform.ir.frames import MODEL, WORLD
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass

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
