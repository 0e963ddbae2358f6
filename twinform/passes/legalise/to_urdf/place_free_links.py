"""Frames in `<gazebo>` by which libsdformat finds the links that floating joints leave free."""

from collections.abc import Container, Iterator
from typing import ClassVar

from twinform.ir import Frame, GazeboExtension, Model
from twinform.passes.carriers.annotations import find_annotation, is_synthesized
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.to_sdf.frame_links import frame_as_before
from twinform.passes.legalise.to_sdf.free_links import placing_frames
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.poses import FRAME


class PlaceFreeLinks(ToUrdfPass):
    """Say where Gazebo finds the links that hang from the first root by floating joints.

    libsdformat writes no such joint, and still poses the link relative to it, so that it refuses the file. A frame by
    the name of the joint, in a `<gazebo>` element, is what it looks for.
    Changes: 1. each floating joint that a conversion synthesized gets such a frame, with the pose of the link; 2. what
    was a frame by the name of a floating joint is none of the links but such a frame again: a `<gazebo>` for the joint
    would set something in the link.
    Never touches: floating joints of the source; a link from which another one hangs.
    Diagnostics: none.
    """

    name: ClassVar[str] = "place-free-links"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with a frame for each synthesized floating joint, and those that others wrote."""
        floating = [joint for joint in model.joints if joint.type == "floating"]
        if not floating:
            return model
        written = {frame.name: frame for frame in _frames_of(model, {joint.name for joint in floating})}
        # The frame is a second pose, and there is no way around it. The one of the joint counts;
        # `stale-carrier` says where an edit has made the two differ.
        frames = (*placing_frames(model, filter(is_synthesized, floating)).values(), *written.values())
        extensions = (GazeboExtension.unchecked(content=(to_element(frame, "frame", "sdf"),)) for frame in frames)
        return model.copy(
            links=tuple(link for link in model.links if link.name not in written),
            joints=tuple(joint for joint in model.joints if joint.child not in written),
            extensions=(*model.extensions, *extensions),
        )


def _frames_of(model: Model, names: Container[str]) -> Iterator[Frame]:
    """The frames with these names that became links, and from which nothing hangs."""
    links = {link.name: link for link in model.links if link.name in names}
    parents = {joint.parent for joint in model.joints}
    for joint in filter(is_synthesized, model.joints):
        link = links.get(joint.child or "")
        annotation = find_annotation(link, FRAME) if link else None
        if link and annotation and link.name not in parents:
            yield frame_as_before(joint, link, annotation, joint.pose)
