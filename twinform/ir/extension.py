"""The `<gazebo>` elements of URDF."""

from twinform.ir.element import Element
from twinform.ir.node import Node
from twinform.ir.record import record


@record
class GazeboExtension(Node):
    """A `<gazebo>` element: what URDF has no elements for and Gazebo reads.

    Attributes:
        reference: the link or joint that it is about; `None` for the model.
        content: the elements in it, in their order.
    """

    reference: str | None = None
    content: tuple[Element, ...] = ()
