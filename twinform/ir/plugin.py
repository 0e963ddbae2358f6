"""Plugins: code that a simulator loads with a model."""

from twinform.ir.element import Element
from twinform.ir.node import Node


class Plugin(Node):
    """A shared library, the class in it and its parameters, which only the plugin understands."""

    name: str | None = None
    filename: str | None = None
    text: str | None = None
    content: tuple[Element, ...] = ()
