"""Poses as six numbers with angles in radians, as before SDF 1.9."""

from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import NOWHERE, rules
from twinform.ir import PLAIN, Document, Element, Node, Opaque, Pose, bits_of, count_parts, map_children, rewrite
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass, map_inside, map_own_elements
from twinform.passes.shared.nodes import pose_piece
from twinform.passes.shared.poses import in_radians, read_pose

AnyNode = TypeVar("AnyNode", bound=Node)
_SINCE = (1, 9)
_ATTRIBUTES = ("rotation_format", "degrees")
_HAVING = PLAIN | bits_of(Pose, "quat_xyzw", *_ATTRIBUTES)


class WritePlainPoses(VersionPass):
    """Write quaternions and degrees as roll, pitch and yaw in radians.

    Changes: every such pose, those in untyped elements too.
    Diagnostics: in the ledger `other-words`.
    """

    name: ClassVar[str] = "write-plain-poses"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with plain poses."""
        return map_children(document, lambda child: rewrite(child, Node, partial(_write_plain, keeper), having=_HAVING))


def _write_plain(keeper: VersionKeeper, node: Node) -> Node:
    node = map_own_elements(node, partial(map_inside, change=partial(_write_plain_in, keeper)))
    pose: Pose | None = getattr(node, "pose", None)
    if pose is None or not (pose.quat_xyzw or pose.degrees is not None or pose.rotation_format is not None):
        return node
    made = in_radians(Transform.from_pose(pose), pose.relative_to).copy(opaque=pose.opaque)
    changed = node.copy(pose=made if made != Pose.unchecked() else None)
    called = getattr(node, "name", None) or type(node).__name__.lower()
    message = f"the pose of {called!r} is written in degrees or as a quaternion"
    weight = count_parts(pose)
    condition = VersionCondition(since=_SINCE)
    return keeper.keep(changed, [pose_piece(pose)], condition, rules.OTHER_WORDS, message, pose.location, weight)


def _write_plain_in(keeper: VersionKeeper, element: Element) -> Element:
    """An untyped element with its own pose in radians, and the one that it had in a carrier."""
    pose = element.find("pose")
    if pose is None or all(pose.get(word) is None for word in _ATTRIBUTES):
        return element
    read = read_pose(pose)
    plain = to_element(in_radians(Transform.from_pose(read), read.relative_to), "pose", "sdf")
    rest = tuple(pair for pair in pose.attributes if pair[0] not in (*_ATTRIBUTES, "relative_to"))
    plain = plain.copy(attributes=(*plain.attributes, *rest))
    message = f"the pose of <{element.name}> is written in degrees or as a quaternion"
    condition = VersionCondition(since=_SINCE, instead="pose")
    carriers = keeper.keep_element(Opaque.unchecked(element=pose), condition, rules.OTHER_WORDS, message, NOWHERE)
    changed = element.exchange(pose, plain)
    return changed.copy(children=(*changed.children, *carriers))
