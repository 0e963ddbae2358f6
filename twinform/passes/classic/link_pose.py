"""Ground-truth pose of a link (gazebo_ros_p3d) by the OdometryPublisher of its model."""

from collections.abc import Iterator

from twinform.ir import Element, Format, Model, Plugin
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.plugins.ground_clearance import base_link
from twinform.schemas import format_value

# Frames that gazebo_ros_p3d takes for the world; any other is a link that the pose is relative to.
_WORLDS = frozenset({"", "world", "/world", "map", "/map"})
_FRAMES = ("frameName", "frame_name")


class OtherQuantityError(Exception):
    """The model's pose in the world is not what the plugin reported; the message has the reason."""


def offset_of(plugin: Plugin, bodies: tuple[str, ...], model: Model | None, format_: Format) -> tuple[Element, ...]:
    """The offset at which the model has the link that a plugin reports the pose of; nothing where they are the same.

    Raises:
        OtherQuantityError: the link moves on its own, there is none, or the pose was relative to another link.
    """
    body = next((child.text or "" for child in plugin.content if child.name in bodies), "").rpartition("::")[2].strip()
    frame = next((child.text or "" for child in plugin.content if child.name in _FRAMES), "").strip()
    # gazebo_ros_p3d reports a link, OdometryPublisher a model. A link fixed to the base gets its
    # offset from the model's frame; any other pose would be a different quantity under the same
    # topic, and is refused.
    if frame not in _WORLDS:
        raise OtherQuantityError(f"the pose was relative to link {frame!r}, and OdometryPublisher knows the world only")
    if model is None or body not in {link.name for link in model.links}:
        raise OtherQuantityError(f"there is no link {body!r} to report the pose of")
    if body not in _rigid(model, base_link(model, format_) or ""):
        reason = f"it reported the pose of link {body!r}, which moves on its own; OdometryPublisher has the model's"
        raise OtherQuantityError(reason)
    try:
        place = FrameGraph(model).pose(body, MODEL, kind="link", base="model")
    except FrameError as error:
        raise OtherQuantityError(error.message) from error
    return tuple(_elements(place))


def _elements(place: Transform) -> Iterator[Element]:
    pose = Transform(place.translation, place.rotation).to_pose()
    if pose.xyz is not None:
        yield Element(name="xyz_offset", text=format_value(pose.xyz))
    if pose.rpy is not None:
        yield Element(name="rpy_offset", text=format_value(pose.rpy))


def _rigid(model: Model, link: str) -> set[str]:
    """The links that keep their place to a link: all that fixed joints lead to."""
    beside: dict[str, list[str]] = {}
    for joint in model.joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            beside.setdefault(joint.parent, []).append(joint.child)
            beside.setdefault(joint.child, []).append(joint.parent)
    # Along fixed joints in both directions: the base may be the child of a fixed joint, as below a
    # base_footprint.
    found, open_ = {link}, [link]
    while open_:
        news = [each for each in beside.get(open_.pop(), ()) if each not in found]
        found.update(news)
        open_ += news
    return found
