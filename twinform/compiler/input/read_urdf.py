"""URDF front end: from a `<robot>` tree to the IR, poses in the terms of the IR.

A joint's origin is in the frame of its parent link, and the child link's frame is the joint's.
"""

from twinform.ir import Document, Format, Model, Pose
from twinform.ir.record import amend, maker
from twinform.schemas import Context, XmlElement, reader

_make_model = maker(Model)
_make_pose = maker(Pose)
_make_document = maker(Document)


def build(root: XmlElement, context: Context) -> Document | None:
    """The document that a `<robot>` makes, but for its namespaces; none where it has errors that leave gaps."""
    data = reader("urdf", context.version).read(root, context)
    if context.broken:
        return None
    model = _make_model(data)
    _relate_poses(model)
    values = {"format": Format.URDF, "models": (model,), "source": model.source, **context.header}
    return _make_document(values)


def _relate_poses(model: Model) -> None:
    """Say which frames the poses of joints and links are in; the nodes are new, so that they may be changed."""
    children: dict[str, str] = {}
    for joint in model.joints:
        parent, child, pose = joint.parent, joint.child, joint.pose
        if parent is not None:
            if pose is None:
                amend(joint, "pose", _make_pose({"relative_to": parent}))
            else:
                amend(pose, "relative_to", parent)
        if child is not None:
            children.setdefault(child, joint.name)
    for link in model.links:
        name = children.get(link.name)
        if name is not None:
            amend(link, "pose", _make_pose({"relative_to": name}))
