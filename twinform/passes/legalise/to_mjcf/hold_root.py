"""Fixes the root of a robot of URDF to the world, where MuJoCo has it, before it becomes a model of SDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Format, Joint, Model
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import (
    EXTENSION,
    annotate_synthesized,
    came_from,
    find_annotation,
    without_synthesized,
)
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.nodes import unique_name


class HoldRoot(ModelPass):
    """Fix the root of a robot of URDF to the world, where MuJoCo's reader of URDF and RViz have it.

    Changes: 1. the link that is no joint's child hangs from the world by a fixed joint, which is annotated as made;
    2. a joint of the file that does so alone is made no longer, since without it there would be another robot.
    Never touches: a robot whose root is a link called `world`; links that floating joints leave free; what was
    converted from SDF or read of MJCF, where a root floats unless it hangs from the world.
    Diagnostics: none.
    """

    name: ClassVar[str] = "hold-root"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with its root on the world."""
        del sink
        # What is in a <gazebo> element closes loops for others.
        children = {joint.child for joint in model.joints if find_annotation(joint, EXTENSION) is None}
        root = next((link for link in model.links if link.name not in children), None)
        may_float = came_from(model, Format.SDF)
        held = [joint for joint in model.joints if joint.parent == WORLD]
        if len(held) == 1 and not may_float:
            joints = (without_synthesized(joint) if joint is held[0] else joint for joint in model.joints)
            return model.copy(joints=tuple(joints))
        if root is None or root.name == WORLD or may_float or held:
            return model
        taken = {node.name for node in (*model.links, *model.joints, *model.frames)}
        name = unique_name(f"{root.name}_on_world", taken)
        joint = Joint.unchecked(name=name, type="fixed", parent=WORLD, child=root.name)
        return model.copy(joints=(annotate_synthesized(joint), *model.joints))
