"""URDF front end: from a `<robot>` tree to the data of the IR."""

from collections.abc import Mapping
from typing import Any

from twinform.schemas import Context, XmlElement, reader


def lower(root: XmlElement, context: Context) -> Mapping[str, Any]:
    """The data of the document that a `<robot>` makes, poses in the terms of the IR.

    A joint's origin is in the frame of its parent link, and the child link's frame is the joint's.
    """
    model = reader("urdf", context.version).read(root, context)
    joints = model.get("joints", ())
    children: dict[str, str] = {}
    for joint in joints:
        if "parent" in joint:
            joint.setdefault("pose", {})["relative_to"] = joint["parent"]
        if "child" in joint and "name" in joint:
            children.setdefault(joint["child"], joint["name"])
    for link in model.get("links", ()):
        joint = children.get(link.get("name"))
        if joint is not None:
            link["pose"] = {"relative_to": joint}
    return {"format": "urdf", "models": (model,), "source": model["source"], **context.header}
