"""Several joints of one body that were one joint with two axes, or of another kind, before it was written as MJCF."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from twinform.compiler.input.mjcf.remainders import holder
from twinform.ir import Element, Joint, Link, Mimic, Model, Opaque, rewrite
from twinform.ir.defaults import multiplier
from twinform.passes.carriers.annotations import annotation, find_annotation
from twinform.passes.carriers.carriers import is_carrier
from twinform.passes.carriers.joint_chains import CHAINS, TWO_AXES, metres_per_radian
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.old_names import scoped_source_name
from twinform.passes.carriers.partial_nodes import REST, written_names
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements


def join_joints(
    model: Model, partials: Iterable[Joint], by_file: Mapping[str, str] = MappingProxyType({})
) -> tuple[Model, list[Joint]]:
    """The model with one joint for the chain of those that a carrier names, as long as they are still one.

    `by_file` has the names of joints by those that they have in the file, if these are others. Returned with the model
    are the partial joints that stand for something else by now.
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
        found = [by_file.get(name, name) for name in names]
        chain = [joints[name] for name in found if name in joints]
        links = [each.child for each in chain[:-1]]
        if len(chain) != len(names) or not _is_one(partial, chain) or not holding.isdisjoint(links):
            left.append(partial)
            continue
        joined |= {**dict.fromkeys(found), chain[-1].name: _joined(partial, chain)}
        between.update(links)
        followed |= {name: _leader(partial, is_last=name == found[-1]) for name in found}
    made = tuple(kept for each in model.joints if (kept := joined.get(each.name, each)) is not None)
    model = model.copy(links=tuple(each for each in model.links if each.name not in between), joints=made)
    return rewrite(model, Mimic, lambda mimic: _led(mimic, followed.get(mimic.joint or ""))), left


def sensors_left(model: Model, left: Iterable[Joint]) -> list[Joint]:
    """Partial joints with the sensors of those that are several joints by now, for the last of these if it is there."""
    joints = {each.name: each for each in model.joints}
    last = ((each, joints.get(written_names(each)[-1])) for each in left if each.sensors)
    return [
        Joint.unchecked(
            name=joint.name, type=joint.type, sensors=each.sensors, opaque=(annotation(REST),), source=each.source
        )
        for each, joint in last
        if joint is not None
    ]


def _is_one(partial: Joint, chain: Sequence[Joint]) -> bool:
    """Whether joints hang from each other, and act as the one that they were."""
    if [each.child for each in chain[:-1]] != [each.parent for each in chain[1:]]:
        return False
    if partial.type == "screw":
        return _is_screw(*chain)
    return all(each.pose == chain[-1].pose and each.type == "revolute" for each in chain)


def _is_screw(slide: Joint, turn: Joint) -> bool:
    """Whether a slide only follows the turn of a screw, along its axis; it is written without its place."""
    along, about = slide.axis, turn.axis
    if along is None or about is None or (slide.type, turn.type) != ("prismatic", "revolute"):
        return False
    led_by = along.mimic.joint if along.mimic is not None else None
    return led_by == turn.name and along.xyz == about.xyz and along.limit is None and along.dynamics is None


def _joined(partial: Joint, chain: Sequence[Joint]) -> Joint:
    """One joint for a chain of them."""
    first, last = chain[0], chain[-1]
    axes = {"axis": last.axis, "axis2": None} if partial.type == "screw" else {"axis": first.axis, "axis2": last.axis}
    return last.copy(
        name=partial.name,
        type=partial.type,
        parent=first.parent,
        opaque=_kept_of(partial, chain),
        **axes,
        **_pitch(partial, first),
    )


def _kept_of(partial: Joint, chain: Sequence[Joint]) -> tuple[Opaque, ...]:
    """What the joints of a chain keep: each for itself under its name, if any keeps something or was renamed."""
    named: list[Element] = []
    others: list[Element] = []
    written = written_names(partial)
    for joint, name in zip(chain, written, strict=True):
        kept = [each for each in kept_elements(joint) if each.name == "joint"]
        attributes = (("name", name), *(pair for each in kept for pair in each.attributes))
        named.append(Element.unchecked(name="joint", attributes=attributes))
        others += (each for each in kept_elements(joint) if each.name != "joint")
    rest = tuple(part for joint in chain for part in joint.opaque if not is_carrier(part, "mjcf"))
    wished = scoped_source_name(partial)
    usual = (f"{wished}_{CHAINS[partial.type][0]}", wished)
    # Where the names were taken, those that were written end in numbers.
    is_usual = all(
        re.fullmatch(rf"{re.escape(wish)}(_\d+)?", name) and len(kept.attributes) == 1
        for wish, name, kept in zip(usual, written, named, strict=True)
    )
    children = tuple(others if is_usual else (*named, *others))
    return (*rest, holder(*children)) if children else rest


def _leader(partial: Joint, *, is_last: bool) -> Mimic:
    """What follows one axis of a joint of two."""
    return Mimic.unchecked(joint=partial.name, axis="axis2" if is_last and partial.type in TWO_AXES else None)


def _led(mimic: Mimic, leader: Mimic | None) -> Mimic:
    return mimic if leader is None else mimic.copy(joint=leader.joint, axis=leader.axis)


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
