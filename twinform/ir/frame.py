"""Named frames that are not bodies."""

from twinform.ir.node import Node
from twinform.ir.pose import Pose


class Frame(Node):
    """A frame that moves with what it is attached to: a link, joint, frame or model; the model itself where not given.

    `pose` is in the frame that it names, or else in the one that this is attached to.
    """

    name: str
    attached_to: str | None = None
    pose: Pose | None = None
