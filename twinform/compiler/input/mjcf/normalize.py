"""Canonical MJCF: the tree of a file in which every element says all of itself."""

from copy import deepcopy

from twinform.compiler.input.load_options import LoadOptions
from twinform.schemas import Context, XmlElement


def normalize(root: XmlElement, context: Context, load_options: LoadOptions) -> XmlElement:
    """Return a canonical copy of a tree."""
    del context, load_options
    return deepcopy(root)
