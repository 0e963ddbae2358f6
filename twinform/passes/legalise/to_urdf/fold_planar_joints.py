"""Folding chains of SDF joints back into one planar joint of URDF."""

from collections.abc import Iterator
from typing import ClassVar, TypeVar

from twinform.diagnostics import rules
from twinform.ir import Joint, Limit, Link, Model, Opaque, Pose
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import fields_of
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import SYNTHESIZED, is_synthesized, without_annotation
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.legalise.to_sdf.joint_types import planar_chain, planar_names
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper

AnyPart = TypeVar("AnyPart", Joint, Link)

_SLIDES = 2
_BESIDE = NOT_CONTENT | {"type", "opaque", "pose"}
"""Fields in which the parts of an unedited chain may differ; poses count for where they put a part."""
_ALMOST = 1e-12
"""By how much places of one frame may differ that were computed in two ways."""


class FoldPlanarJoints(ToUrdfPass):
    """Put planar joints of URDF, which are three joints and two links in SDF, together again.

    Changes: 1. the joint that was called so is planar, and has the parent and the place of the first one of its chain;
    2. the other two joints and the links between them go.
    Never touches: chains that did not come from a planar joint. Those that were edited since stay, without their
    annotations, also where one joint has a name of its own, as a planar joint names the others after itself.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "fold-planar-joints"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with planar joints."""
        annotated = [joint for joint in model.joints if any(_is_annotation(part) for part in joint.opaque)]
        if not annotated:
            return model
        above = {joint.child: joint for joint in model.joints}
        links = {link.name: link for link in model.links}
        taken = {node.name for node in (*model.links, *model.joints, *model.frames)}
        graph = FrameGraph(model)
        folded: dict[str, Joint] = {}
        gone: set[str] = set()
        stale: set[str] = set()
        for joint in annotated:
            chain = _find_chain(joint, above, links)
            # Made anew and compared: the planar joint returns only if it would become exactly this
            # chain, names included. A name that somebody gave to a part is one that plugins know,
            # and a planar joint has no place for it.
            if chain is None or not (_is_as_made(joint, chain, links, taken) and _is_in_one_place(joint, chain, graph)):
                message = (
                    f"joint {joint.name!r} was planar, and the joints that it became, or their names, have changed"
                )
                keeper.sink.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)
                folded[joint.name] = joint.copy(opaque=_without_planar(joint))
                stale |= set(_upwards(joint, above))
            else:
                first, second = chain
                folded[joint.name] = _make_planar(joint, first.copy(pose=_place(chain, graph)))
                gone |= {first.name, second.name, first.child or "", second.child or ""}
        joints = (folded.get(joint.name, joint) for joint in model.joints if joint.name not in gone)
        kept = (link for link in model.links if link.name not in gone)
        update = {
            "joints": tuple(_without_stale_mark(joint, stale) for joint in joints),
            "links": tuple(_without_stale_mark(one, stale) for one in kept),
        }
        return model.copy(**update)


def _upwards(joint: Joint, above: dict[str | None, Joint]) -> Iterator[str]:
    """The names of the joints and links of a chain above its last joint."""
    for _ in range(_SLIDES):
        upper = above.get(joint.parent)
        if upper is None:
            return
        yield from (upper.name, joint.parent or "")
        joint = upper


def _without_stale_mark(part: AnyPart, stale: set[str]) -> AnyPart:
    """A part of a chain that is not folded, without the annotation that it was synthesized."""
    return without_annotation(part, SYNTHESIZED) if part.name in stale else part


def _is_annotation(part: Opaque) -> bool:
    return is_carrier(part, "urdf") and any(piece.attribute == ("type", "planar") for piece in unpack(part))


def _find_chain(joint: Joint, above: dict[str | None, Joint], links: dict[str, Link]) -> tuple[Joint, Joint] | None:
    """The two sliding joints of a chain; None where the chain was edited."""
    second = above.get(joint.parent)
    first = above.get(second.parent) if second else None
    if first is None or second is None or joint.type not in {"continuous", "revolute"}:
        return None
    between = [links.get(first.child or ""), links.get(second.child or "")]
    made = [part is not None and is_synthesized(part) for part in (first, second, *between)]
    return (first, second) if all(made) and {first.type, second.type} == {"prismatic"} else None


def _is_as_made(turn: Joint, chain: tuple[Joint, Joint], links: dict[str, Link], taken: set[str]) -> bool:
    """Whether a chain equals the one that a planar joint with its present axis and pose becomes."""
    first, second = chain
    between = (links[first.child or ""], links[second.child or ""])
    names = {part.name for part in (*chain, *between)}
    taken -= names
    made = planar_chain(_make_planar(turn, first), planar_names(turn.name, taken))
    taken |= names
    parts = zip((first, second, turn, *between), (*made.joints, *made.links), strict=True)
    return all(_motion_of(is_now) == _motion_of(was) for is_now, was in parts)


def _is_in_one_place(turn: Joint, chain: tuple[Joint, Joint], graph: FrameGraph) -> bool:
    """Whether all frames of a chain are where its first joint is, as in the one that a planar joint becomes."""
    first, second = chain
    try:
        _place(chain, graph)
        joints = [graph.pose(each.name, first.name, kind="joint", base="joint") for each in (second, turn)]
        links = [graph.pose(each.child or "", first.name, base="joint") for each in chain]
        return all(map(_is_identity, (*joints, *links)))
    except FrameError:  # an edit has left a pose without its frame
        return False


def _is_identity(placed: Transform) -> bool:
    return placed.is_identity or all(abs(each) < _ALMOST for each in (*placed.translation, *placed.rpy()))


def _place(chain: tuple[Joint, Joint], graph: FrameGraph) -> Pose | None:
    """The pose of the first joint of a chain, from its parent where it is written from a part that goes.

    Raises:
        FrameError: there is no such parent.
    """
    first, second = chain
    gone = {None, first.child, second.name, second.child}
    if first.parent is None or (first.pose is not None and first.pose.relative_to not in gone):
        return first.pose
    return graph.pose(first.name, first.parent, kind="joint").to_pose(relative_to=first.parent)


def _motion_of(part: Joint | Link) -> dict[str, object]:
    """The fields of a part that matter for its motion; an empty limit counts as none."""
    written = {name: getattr(part, name) for name in fields_of(type(part)) if name not in _BESIDE}
    if isinstance(part, Joint) and part.axis is not None:
        limit = None if part.axis.limit == Limit.unchecked() else part.axis.limit
        written["axis"] = part.axis.copy(limit=limit, opaque=())
    return written


def _make_planar(joint: Joint, first: Joint) -> Joint:
    update = {"type": "planar", "parent": first.parent, "pose": first.pose, "opaque": _without_planar(joint)}
    return joint.copy(**update)


def _without_planar(joint: Joint) -> tuple[Opaque, ...]:
    return tuple(part for part in joint.opaque if not _is_annotation(part))
