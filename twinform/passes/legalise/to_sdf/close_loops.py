"""Conversion of what closes a loop in URDF for other readers to joints of SDF."""

from collections import Counter
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Format, Joint, Model, Opaque, count_parts
from twinform.ir.foreign_joints import closes_loop, foreign_joints
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.groups import Groups
from twinform.passes.carriers.annotations import came_from
from twinform.passes.carriers.carriers import Keeper, carry, to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.loop_elements import OpenLoopError, behind_tree, read_loop, require_closed
from twinform.passes.shared.nodes import reserve_name


class CloseLoops(ModelPass):
    """Close loops by joints of SDF, where URDF has elements of other readers for them.

    Changes: Isaac's `<loop_joint>`, `<drake:ball_constraint>` and the `<constraint>` proposed for urdfdom become
    joints, which are annotated with what only the element says; those that no joint of SDF is are carried: their ends
    do not meet where all joints are at zero, or they say more. So is a joint to a second parent that has the link
    elsewhere than the first one; others are such joints already.
    Never touches: any other element or joint.
    Diagnostics: `open-loop` for what is carried, or dropped with `carriers` false.
    """

    name: ClassVar[str] = "close-loops"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with joints that close loops."""
        loops = [each for each in foreign_joints(model) if each.form is not None]
        if sink.has_errors:
            return model
        keeper = Keeper(sink, self.carriers)
        model = _leave_open(model, keeper)
        if not loops:
            return model
        annotated = self.carriers and not came_from(model, Format.SDF)
        links = frozenset(link.name for link in model.links)
        taken = {node.name for node in (*model.links, *model.joints, *(each.joint for each in loops))}
        graph, fixed = FrameGraph(model), _fixed_groups(model)
        closing, left, between = list[Joint](), list[Opaque](), Counter[str]()
        for each in loops:
            name = each.joint.name or reserve_name(_name_loop(each.joint, between), taken)
            try:
                _require_motion(each.joint, fixed)
                closing.append(read_loop(each, name, graph, links, annotated=annotated))
            except (OpenLoopError, FrameError) as error:
                called = f"<{each.word}> {each.joint.name!r}" if each.joint.name else f"<{each.word}>"
                message = f"{called} closes no loop in SDF: {error}"
                sink.report(rules.OPEN_LOOP, message, each.joint.location, found=f"<{each.word}>")
                keeper.account(rules.OPEN_LOOP, message, each.part.location, each.part.weight)
                left.append(each.part)
        opaque = tuple(part for part in model.opaque if not closes_loop(part))
        model = model.copy(joints=(*model.joints, *behind_tree(closing, model.joints)), opaque=opaque)
        return carry(model, left, "urdf") if self.carriers else model


def _name_loop(joint: Joint, between: Counter[str]) -> str:
    """A name for a loop that has none; `between` counts those between the same links."""
    name = f"{joint.parent}_{joint.child}_loop"
    number = between[name]  # counted here: to try all numbers for each of many would take the square of their time
    between[name] += 1
    return f"{name}_{number}" if number else name


def _leave_open(model: Model, keeper: Keeper) -> Model:
    """The model without the joints that give a link a second parent which has it elsewhere than the first one."""
    first = {joint.child: joint.name for joint in reversed(model.joints)}
    if len(first) == len(model.joints):
        return model
    graph, kept, left = FrameGraph(model), list[Joint](), list[Opaque]()
    for joint in model.joints:
        try:
            if first[joint.child] != joint.name:
                require_closed(graph.pose(joint.name, joint.child or "", kind="joint"), "fixed")
            kept.append(joint)
        except (OpenLoopError, FrameError) as error:
            message = f"joint {joint.name!r} closes no loop in SDF: {error}"
            keeper.sink.report(rules.OPEN_LOOP, message, joint.location, found=joint.name)
            keeper.account(rules.OPEN_LOOP, message, joint.location, count_parts(joint))
            left.append(Opaque.unchecked(element=to_element(joint, "joint", "urdf"), source=joint.source))
    model = model.copy(joints=tuple(kept))
    return carry(model, left, "urdf") if keeper.carriers else model


def _fixed_groups(model: Model) -> Groups:
    """The links that fixed joints hold together."""
    groups = Groups()
    for joint in model.joints:
        if joint.type == "fixed":
            groups.join(joint.parent or "", joint.child or "")
    return groups


def _require_motion(joint: Joint, fixed: Groups) -> None:
    if fixed.find(joint.parent or "") == fixed.find(joint.child or ""):
        raise OpenLoopError("its ends are fixed to each other")
