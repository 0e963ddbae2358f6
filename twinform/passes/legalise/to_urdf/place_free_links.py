"""Frames in `<gazebo>` by which libsdformat finds the links that floating joints leave free."""

from typing import ClassVar

from twinform.ir import GazeboExtension, Model
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.to_sdf.free_links import placing_frames
from twinform.passes.legalise.to_urdf.base import Keeper, ToUrdfPass


class PlaceFreeLinks(ToUrdfPass):
    """Say where Gazebo finds the links that hang from the first root by floating joints.

    libsdformat writes no such joint, and still poses the link relative to it, so that it refuses the file. A frame by
    the name of the joint, in a `<gazebo>` element, is what it looks for.
    Changes: each floating joint that a conversion synthesized gets such a frame, with the pose of the link.
    Never touches: floating joints of the source.
    Diagnostics: none.
    """

    name: ClassVar[str] = "place-free-links"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with a frame for each synthesized floating joint."""
        free = [joint for joint in model.joints if joint.type == "floating" and is_synthesized(joint)]
        if not free:
            return model
        frames = placing_frames(model, free).values()
        extensions = (GazeboExtension(content=(to_element(frame, "frame", "sdf"),)) for frame in frames)
        return model.copy(extensions=(*model.extensions, *extensions))
