"""Chains that came from one joint of SDF become that joint again."""

from collections.abc import Iterator
from typing import ClassVar, TypeVar

from twinform.diagnostics import Notes
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Axis, Joint, Link, Model
from twinform.passes.legalise.joint_chains import PART_OF, TWO_AXES, TYPE, is_chain_mark, marked
from twinform.passes.legalise.marks import MADE
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.to_sdf.chains import Chain, StaleChainError, find_chain, folded

AnyPart = TypeVar("AnyPart", Joint, Link)


class FoldJoints(ModelPass):
    """Put ball, universal, revolute2 and screw joints of SDF, which are chains in URDF, together again.

    Changes: 1. the last joint of a chain has its type, parent and place again, and the axes as the chain says them now;
    2. the other joints and the links between go; 3. what mimics the first joint of two mimics `axis` of the one, what
    mimics the last `axis2`.
    Never touches: chains that were edited so that they are not such a joint any more; their marks go.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "fold-joints"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without chains."""
        marks = [node for node in (*model.joints, *model.links) if _is_marked(node)]
        if not marks:
            return model
        made: dict[str, Joint] = {}
        first: dict[str, str] = {}
        gone: set[str] = set()
        for chain in _chains(model, notes):
            made[chain.last.name] = folded(chain)
            gone |= {part.name for part in (*chain.above, *chain.between)}
            if made[chain.last.name].type in TWO_AXES:
                first[chain.above[0].name] = chain.last.name
        joints = (made.get(joint.name) or _unmarked(joint) for joint in model.joints if joint.name not in gone)
        links = (_unmarked(link) for link in model.links if link.name not in gone)
        followed = tuple(_follow(joint, first) for joint in joints)
        return model.model_copy(update={"joints": followed, "links": tuple(links)})


def _chains(model: Model, notes: Notes) -> Iterator[Chain]:
    """The chains that still are what they were made; the others are reported."""
    for joint in model.joints:
        kind = marked(joint, TYPE)
        if kind is None:
            continue
        try:
            yield find_chain(joint, kind, model)
        except StaleChainError as error:
            message = f"joint {joint.name!r} was {kind}, and the chain that it became has changed: {error}"
            notes.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)


def _is_marked(node: Joint | Link) -> bool:
    return marked(node, TYPE) is not None or marked(node, PART_OF) is not None


def _unmarked(node: AnyPart) -> AnyPart:
    """A part of a chain that stays: it was made, and stands for itself now."""
    if not _is_marked(node):
        return node
    kept = tuple(part for part in node.opaque if not is_chain_mark(part) and not _is_whole(part.attribute))
    return node.model_copy(update={"opaque": kept})


def _is_whole(attribute: tuple[str, str] | None) -> bool:
    """Whether it says that the whole node was made."""
    return attribute == (MADE, ".")


def _follow(joint: Joint, first: dict[str, str]) -> Joint:
    update = {field: _follows(getattr(joint, field), first) for field in ("axis", "axis2")}
    changed = {field: axis for field, axis in update.items() if axis is not getattr(joint, field)}
    return joint.model_copy(update=changed) if changed else joint


def _follows(axis: Axis | None, first: dict[str, str]) -> Axis | None:
    """The axis with its mimic of a joint in a chain of two, now of one of the two axes of one joint."""
    mimic = axis.mimic if axis else None
    if axis is None or mimic is None:
        return axis
    if mimic.joint in first:
        mimic = mimic.model_copy(update={"joint": first[mimic.joint]})
    elif mimic.joint in first.values():
        mimic = mimic.model_copy(update={"axis": "axis2"})
    return axis if mimic is axis.mimic else axis.model_copy(update={"mimic": mimic})
