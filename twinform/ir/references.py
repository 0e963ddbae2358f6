"""Which fields of the IR are references by name, what kind of thing each names, and how to change them all."""

from collections.abc import Callable
from functools import cache
from typing import Literal, TypeVar

from twinform.dataclass import dataclass
from twinform.ir.document import Format
from twinform.ir.joint import Axis, Joint, Mimic
from twinform.ir.link import Link
from twinform.ir.model import GazeboExtension, Include, Model
from twinform.ir.node import Node
from twinform.ir.pose import Frame, Pose
from twinform.ir.rewrite import (
    RARE,
    bits_of,
    census_of,
    classes_below,
    classes_in,
    map_children,
    node_fields,
    union_of,
)
from twinform.ir.sensor import Sensor
from twinform.ir.visual import Material

AnyNode = TypeVar("AnyNode", bound=Node)

ReferenceKind = Literal["link", "joint", "any", "frame", "material"]
"""What a name means where several things share it: SDF since 1.7 has one scope for all, URDF one for each kind.

`any`: a frame of SDF, which is a link, joint, frame or model; `frame`: a coordinate frame of ROS, which a link, or a
massless one that stands for it, gives its name to; `material`: a shared material of URDF.
"""
ReferenceChange = Callable[[ReferenceKind, str], str]
"""The new name of what a reference of this kind names."""

# A table and not annotations on the fields, since the kind is not a matter of the field alone: the
# pose of a link names a joint in URDF and any frame in SDF, and the pose of a nested model belongs
# to the scope around it. A test wants every text field of the IR here or in a list of those that
# are no references.
REFERENCES: dict[type[Node], dict[str, ReferenceKind]] = {
    Axis: {"expressed_in": "any"},
    Frame: {"attached_to": "any"},
    GazeboExtension: {"reference": "link"},
    Joint: {"parent": "link", "child": "link", "gearbox_reference_body": "link"},
    Material: {"name": "material"},
    Mimic: {"joint": "joint"},
    Model: {"canonical_link": "link", "placement_frame": "any"},
    Pose: {"relative_to": "any"},
    Sensor: {"frame_id": "frame"},
}
POSES_IN_URDF: dict[type[Node], ReferenceKind] = {Link: "joint", Joint: "link"}
"""What the pose of a link or joint is relative to in URDF."""
IN_MODELS: frozenset[ReferenceKind] = frozenset({"link", "joint", "any"})
"""The kinds of what a model of SDF holds, and names by `inner::name` where it is in a nested one."""


def map_references(node: AnyNode, change: ReferenceChange, format_: Format = Format.SDF) -> AnyNode:
    """The node with every reference in it changed; the same node where none is.

    Of a model or world these are the references in its own scope. Its pose, which is in the scope around it, is not
    among them; the poses of models and includes in it are, and nothing else that these say.
    """
    return _Mapper(change, POSES_IN_URDF if format_ is Format.URDF else {}).inside(node)


@dataclass(frozen=True, slots=True)
class _Mapper:
    """Changes the references of one scope; `poses` has the kinds of those poses that are no frames of SDF."""

    change: ReferenceChange
    poses: dict[type[Node], ReferenceKind]

    def inside(self, node: AnyNode) -> AnyNode:
        if not census_of(node) & _referring():
            return node
        changed = self.own(node, REFERENCES.get(type(node), {}))
        return map_children(changed, lambda child: self.child(child, node)) if _has_more(type(node)) else changed

    def child(self, child: Node, holder: Node) -> Node:
        if isinstance(child, Pose):
            kind = self.poses.get(type(holder), "any")
            return child if isinstance(holder, Model) else self.own(child, {"relative_to": kind})
        if isinstance(child, Model | Include):
            pose = child.pose and self.own(child.pose, REFERENCES[Pose])
            return child if pose is child.pose else child.copy(pose=pose)
        return self.inside(child)

    def own(self, node: AnyNode, kinds: dict[str, ReferenceKind]) -> AnyNode:
        """The node with the references that are its own fields."""
        update: dict[str, str] = {}
        for field, kind in kinds.items():
            name = getattr(node, field)
            if name and (new := self.change(kind, name)) != name:
                update[field] = new
        return node.copy(**update) if update else node


@cache
def _referring() -> int:
    """The bits of nodes that may refer to something: of fields that few models write, and otherwise of classes."""
    return union_of(
        bits_of(kind, *(fields if fields.keys() <= {*RARE.get(kind, ())} else ()))
        for kind, fields in REFERENCES.items()
    )


@cache
def _has_more(kind: type[Node]) -> bool:
    """Whether a node of this class may have references in the nodes inside it."""
    inside = (inner for name in node_fields(kind) for inner in classes_in(kind, name))
    return any(not REFERENCES.keys().isdisjoint(classes_below(inner)) for inner in inside)
