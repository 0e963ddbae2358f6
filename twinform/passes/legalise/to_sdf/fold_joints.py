"""Folding chains of URDF joints back into one multi-axis SDF joint."""

from collections.abc import Container, Iterator
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Joint, Link, Model
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.joint_chains import CHAIN, PART, TWO_AXES, chain_type, part_of
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_sdf.chains import ChainNeighbors, JointChain, StaleChainError, find_chain, folded

AnyPart = TypeVar("AnyPart", Joint, Link)


class FoldJoints(ModelPass):
    """Put ball, universal, revolute2 and screw joints of SDF, which are chains in URDF, together again.

    Changes: 1. the last joint of a chain has its type, parent and place again, and the axes as the chain has them now;
    2. the other joints and the links between go; 3. what mimics the first joint of two mimics `axis` of the one, what
    mimics the last `axis2`.
    Never touches: chains that were edited so that they are not such a joint any more, or of which another joint mimics
    a part that the one joint has no axis for; their annotations go, and
    so does the mimic of a slide that has nothing to follow any more.
    Diagnostics: `stale-carrier`, also for parts whose own names get lost.
    """

    name: ClassVar[str] = "fold-joints"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without chains."""
        annotations = [node for node in (*model.joints, *model.links) if _is_annotated(node)]
        if not annotations:
            return model
        made: dict[str, Joint] = {}
        first: dict[str, str] = {}
        gone: set[str] = set()
        for chain, joint in _fold_chains(model, sink):
            made[joint.name] = joint
            gone |= {part.name for part in (*chain.above, *chain.between)}
            if joint.type in TWO_AXES:
                first[chain.above[0].name] = chain.last.name
        names = {joint.name for joint in model.joints}
        joints = (
            made.get(joint.name) or _without_marks(_without_lost_mimic(joint, names))
            for joint in model.joints
            if joint.name not in gone
        )
        links = (_without_marks(link) for link in model.links if link.name not in gone)
        second = frozenset(first.values())
        followed = tuple(_follow_axes(joint, first, second) for joint in joints)
        return model.copy(joints=followed, links=tuple(links))


def _fold_chains(model: Model, sink: DiagnosticSink) -> Iterator[tuple[JointChain, Joint]]:
    """The intact chains with the joints that they fold into; edited chains are reported."""
    around = ChainNeighbors.of(model)
    for joint in model.joints:
        kind = chain_type(joint)
        if kind is None:
            continue
        try:
            chain = find_chain(joint, kind, around)
            made = folded(chain)
        except StaleChainError as error:
            message = f"joint {joint.name!r} was {kind}, and the chain that it became has changed: {error}"
            sink.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)
        else:
            _report_names(chain, sink)
            yield chain, made


def _report_names(chain: JointChain, sink: DiagnosticSink) -> None:
    """Report the parts of a chain that were renamed by hand, whose names get lost."""
    for part in (*chain.above, *chain.between):
        # A name that somebody gave to a part is one that controllers and plugins of the URDF may
        # know, and the one joint has no place for it.
        if not part.name.startswith(chain.last.name):
            message = f"{part.name!r} is a part of the {chain.kind} joint {chain.last.name!r}, and has no name in SDF"
            sink.report(rules.STALE_CARRIER, message, part.location, found=part.name)


def _is_annotated(node: Joint | Link) -> bool:
    return find_annotation(node, CHAIN) is not None or find_annotation(node, PART) is not None


def _without_marks(node: AnyPart) -> AnyPart:
    """A part of a chain that is not folded, without its annotations."""
    return without_annotation(node, CHAIN, PART)


def _without_lost_mimic(joint: Joint, names: Container[str]) -> Joint:
    """The slide of a screw without its synthesized mimic, if the joint that it mimics is gone."""
    mimic = joint.axis.mimic if joint.axis and part_of(joint) else None
    if joint.axis is None or mimic is None or (mimic.joint or "") in names:
        return joint
    return joint.copy(axis=joint.axis.copy(mimic=None))


def _follow_axes(joint: Joint, first: dict[str, str], second: frozenset[str]) -> Joint:
    update = {field: _follow_axis(getattr(joint, field), first, second) for field in ("axis", "axis2")}
    changed = {field: axis for field, axis in update.items() if axis is not getattr(joint, field)}
    return joint.copy(**changed) if changed else joint


def _follow_axis(axis: Axis | None, first: dict[str, str], second: frozenset[str]) -> Axis | None:
    """The axis with a mimic of a chain joint turned into a mimic of an axis of the folded joint."""
    mimic = axis.mimic if axis else None
    if axis is None or mimic is None:
        return axis
    if mimic.joint in first:
        mimic = mimic.copy(joint=first[mimic.joint])
    elif mimic.joint in second:
        mimic = mimic.copy(axis="axis2")
    return axis if mimic is axis.mimic else axis.copy(mimic=mimic)
