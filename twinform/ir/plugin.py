"""Plugins: code that a simulator loads with a model."""

from twinform.ir.element import Element
from twinform.ir.node import Node
from twinform.ir.record import record


@record
class Plugin(Node):
    """Code that a simulator loads, with parameters that only the plugin understands.

    Attributes:
        name: in Gazebo the class in the library; in Gazebo Classic any name.
        filename: the shared library.
        text: the text in it, where it is not made of elements.
        content: its parameters, in their order.
    """

    name: str | None = None
    filename: str | None = None
    text: str | None = None
    content: tuple[Element, ...] = ()
