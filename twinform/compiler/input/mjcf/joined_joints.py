"""Several joints of one body that were one joint with two axes, or of another kind, before it was written as MJCF."""

import math
from collections.abc import Iterable, Sequence

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
    several = [(each, names) for each in partials if len(names := written_names(each)) > 1]
    several = [each for each in several if find_annotation(each[0], LOOP) is None]
    if not several:
        return model, []
    joints = {each.name: each for each in model.joints}
    holding = {each.name for each in model.links if not _is_bare(each)}
    left: list[Joint] = []
    joined: dict[str, Joint | None] = {}
    between: set[str | None] = set()
    followed: dict[str, Mimic] = {}
    for partial, names in several:
        chain = [joints[name] for name in names if name in joints]
        links = [each.child for each in chain[:-1]]
        if len(chain) != len(names) or not _is_one(partial, chain) or not holding.isdisjoint(links):
            left.append(partial)
            continue
        joined |= {**dict.fromkeys(names), chain[-1].name: _joined(partial, chain)}
        between.update(links)
        followed |= {name: _leader(partial, is_last=name == names[-1]) for name in names}
    made = tuple(kept for each in model.joints if (kept := joined.get(each.name, each)) is not None)
    model = model.copy(links=tuple(each for each in model.links if each.name not in between), joints=made)
    return rewrite(model, Mimic, lambda mimic: _led(mimic, followed.get(mimic.joint or ""))), left


def _is_one(partial: Joint, chain: Sequence[Joint]) -> bool:
    """Whether joints hang from each other, and act as the one that they were."""
    if [each.child for each in chain[:-1]] != [each.parent for each in chain[1:]]:
        return False
    # A slide is written without its place, which changes no motion.
    return _is_led(chain[0]) if partial.type == "screw" else all(each.pose == chain[-1].pose for each in chain)


def _joined(partial: Joint, chain: Sequence[Joint]) -> Joint:
    """One joint for a chain of them."""
    first, last = chain[0], chain[-1]
    axes = {"axis": last.axis, "axis2": None} if partial.type == "screw" else {"axis": first.axis, "axis2": last.axis}
    return last.copy(
        name=partial.name,
        type=partial.type,
        parent=first.parent,
        opaque=tuple(part for each in chain for part in each.opaque),
        **axes,
        **_pitch(partial, first),
    )


def _leader(partial: Joint, *, is_last: bool) -> Mimic:
    """What follows one axis of a joint of two."""
    return Mimic.unchecked(joint=partial.name, axis="axis2" if is_last and partial.type in TWO_AXES else None)


def _led(mimic: Mimic, leader: Mimic | None) -> Mimic:
    return mimic if leader is None else mimic.copy(joint=leader.joint, axis=leader.axis)


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
