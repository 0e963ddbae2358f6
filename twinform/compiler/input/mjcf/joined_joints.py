"""Several joints of one body that were one joint with two axes, or of another kind, before it was written as MJCF."""

import math
from collections.abc import Iterable

from twinform.ir import Joint, Link, Mimic, Model, rewrite
from twinform.ir.defaults import multiplier
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.joint_chains import TWO_AXES, metres_per_radian
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.partial_nodes import written_names


def join_joints(model: Model, partials: Iterable[Joint]) -> tuple[Model, list[Joint]]:
    """The model with one joint for the chain of those that a carrier names, as long as they are still one.

    Returned with it are the partial joints that stand for something else by now.
    """
    left: list[Joint] = []
    for partial in partials:
        names = written_names(partial)
        if len(names) > 1 and find_annotation(partial, LOOP) is None:
            joined = _joined(model, partial, names)
            if joined is model:
                left.append(partial)
            model = joined
    return model, left


def _joined(model: Model, partial: Joint, names: list[str]) -> Model:
    by_name = {each.name: each for each in model.joints}
    chain = [by_name[name] for name in names if name in by_name]
    between = [each.child for each in chain[:-1]]
    if len(chain) != len(names) or between != [each.parent for each in chain[1:]]:
        return model
    if not all(_is_bare(link) for link in model.links if link.name in between):
        return model
    last = chain[-1]
    # A slide is written without its place, which changes no motion.
    is_one = _is_led(chain[0]) if partial.type == "screw" else all(each.pose == last.pose for each in chain)
    if not is_one:
        return model
    axes = {"axis": chain[0].axis, "axis2": last.axis}
    if partial.type == "screw":
        axes = {"axis": last.axis, "axis2": None}
    joint = last.copy(
        name=partial.name,
        type=partial.type,
        parent=chain[0].parent,
        opaque=tuple(part for each in chain for part in each.opaque),
        **axes,
        **_pitch(partial, chain[0]),
    )
    joints = tuple(joint if each is last else each for each in model.joints if each is last or each not in chain)
    links = tuple(each for each in model.links if each.name not in between)
    joined = model.copy(links=links, joints=joints)
    return rewrite(joined, Mimic, lambda mimic: _led(mimic, names, partial))


def _led(mimic: Mimic, names: list[str], partial: Joint) -> Mimic:
    """A mimic that follows one axis of a joint of two."""
    if mimic.joint not in names:
        return mimic
    second = partial.type in TWO_AXES and mimic.joint == names[-1]
    return mimic.copy(joint=partial.name, axis="axis2" if second else None)


def _is_led(slide: Joint) -> bool:
    """Whether a slide only follows the turn of a screw."""
    axis = slide.axis
    return axis is not None and axis.mimic is not None and axis.limit is None and axis.dynamics is None


def _pitch(partial: Joint, slide: Joint) -> dict[str, float]:
    """The pitch of a screw in m per turn, if an edit has changed it: the slide follows the hinge by it."""
    mimic = slide.axis.mimic if slide.axis else None
    if partial.type != "screw" or mimic is None:
        return {}
    written, kept = multiplier(mimic), metres_per_radian(partial)
    if kept is not None and math.isclose(written, kept, rel_tol=1e-9):
        return {}
    return {"screw_thread_pitch": written * math.tau}


def _is_bare(link: Link) -> bool:
    return not (link.visuals or link.collisions or link.sensors or link.lights)
