"""The `<gazebo>` elements of URDF."""

from twinform.ir.element import Element
from twinform.ir.node import Node


class GazeboExtension(Node):
    """What URDF has no elements for and Gazebo reads, for the link or joint `reference`; without one, for the model."""

    reference: str | None = None
    content: tuple[Element, ...] = ()
