"""Frames in `<gazebo>` by which libsdformat finds the links that floating joints leave free."""

from typing import ClassVar

from twinform.ir import Element, Frame, GazeboExtension, Joint, Model
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.annotations import annotate_synthesized, is_synthesized
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.to_urdf.base import Keeper, ToUrdfPass


class PlaceFreeLinks(ToUrdfPass):
    """Say where Gazebo finds the links that hang from the first root by floating joints.

    libsdformat writes no such joint, and still poses the link relative to it, so that it refuses the file
    (parser_urdf.cc, CreateLink). A frame by the name of the joint, in a `<gazebo>` element, is what it looks for.
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
        children = {joint.child for joint in model.joints}
        root = next(link.name for link in model.links if link.name not in children)
        graph = FrameGraph(model)
        extensions = tuple(_placed(joint, root, graph) for joint in free)
        return model.model_copy(update={"extensions": (*model.extensions, *extensions)})


def _placed(joint: Joint, root: str, graph: FrameGraph) -> GazeboExtension:
    pose = graph.pose(joint.child or "", root).to_pose()
    frame: Element = to_element(annotate_synthesized(Frame(name=joint.name, pose=pose)), "frame", "sdf")
    return GazeboExtension(content=(frame,))
